//! The memory that a container, or another control group of the system, leaves to this process.
//!
//! # Source
//! The documentation of the Linux kernel: `admin-guide/cgroup-v2.rst` and `admin-guide/cgroup-v1/memory.rst`.

use std::fs::read_to_string;
use std::path::Path;

/// Limits from which on a group has none: version 1 states the largest number of pages.
const NO_LIMIT: f64 = 1e18;

/// The names of the files of a group: its limit, what it uses, and in its statistics the part that the system takes back at any time.
struct GroupFiles {
    limit: &'static str,
    used: &'static str,
    returnable: &'static str,
}

const VERSION_1: GroupFiles =
    GroupFiles { limit: "memory.limit_in_bytes", used: "memory.usage_in_bytes", returnable: "total_inactive_file" };
const VERSION_2: GroupFiles = GroupFiles { limit: "memory.max", used: "memory.current", returnable: "inactive_file" };

/// The fewest bytes that the groups of this process leave; none where there is no limit.
pub(super) fn bytes_left() -> Option<f64> {
    let groups = read_to_string("/proc/self/cgroup").ok()?;
    left_in(Path::new("/sys/fs/cgroup"), &groups)
}

/// The fewest bytes that some groups leave, whose files are below a folder. Each line names one: a number, what it controls, and its path. Those around
/// it limit it as well, and a container sees its own group at the top.
fn left_in(root: &Path, groups: &str) -> Option<f64> {
    let mut least: Option<f64> = None;
    for line in groups.lines() {
        let mut words = line.splitn(3, ':').skip(1);
        let (Some(controlled), Some(path)) = (words.next(), words.next()) else { continue };
        let (root, files) = match controlled {
            "" => (root.to_owned(), &VERSION_2),
            it if it.split(',').any(|it| it == "memory") => (root.join("memory"), &VERSION_1),
            _ => continue,
        };
        for group in Path::new(path.trim_start_matches('/')).ancestors() {
            if let Some(left) = files.bytes_left(&root.join(group)) {
                least = Some(least.map_or(left, |least| least.min(left)));
            }
        }
    }
    least
}

impl GroupFiles {
    /// The bytes that the group of a folder leaves; none without a limit.
    fn bytes_left(&self, group: &Path) -> Option<f64> {
        let number = |name: &str| read_to_string(group.join(name)).ok()?.trim().parse::<f64>().ok();
        let limit = number(self.limit).filter(|limit| *limit < NO_LIMIT)?;
        let statistics = read_to_string(group.join("memory.stat")).unwrap_or_default();
        let returnable =
            statistics.lines().find_map(|line| line.strip_prefix(self.returnable)?.trim().parse::<f64>().ok());
        Some((limit - number(self.used)? + returnable.unwrap_or(0.0)).max(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn write(root: &Path, files: &[(&str, &str)]) {
        for (name, text) in files {
            let path = root.join(name);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, text).unwrap();
        }
    }

    #[test]
    fn the_tightest_group_of_version_2_counts() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path();
        write(
            root,
            &[
                ("a/memory.max", "max\n"),
                ("a/memory.current", "5\n"),
                ("a/b/memory.max", "1000\n"),
                ("a/b/memory.current", "700\n"),
                ("a/b/memory.stat", "anon 500\ninactive_file 200\nactive_file 0\n"),
                ("a/b/c/memory.max", "800\n"),
                ("a/b/c/memory.current", "100\n"),
            ],
        );
        assert_eq!(left_in(root, "0::/a/b/c\n"), Some(500.0));
        assert_eq!(left_in(root, "0::/a\n"), None);
        assert_eq!(left_in(root, "0::/elsewhere\n"), None);
    }

    #[test]
    fn groups_of_version_1_count_and_a_container_sees_its_own_at_the_top() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path();
        write(
            root,
            &[
                ("memory/memory.limit_in_bytes", "4000\n"),
                ("memory/memory.usage_in_bytes", "1000\n"),
                ("memory/memory.stat", "cache 7\ntotal_inactive_file 10\n"),
                ("memory/x/memory.limit_in_bytes", "9223372036854771712\n"),
                ("memory/x/memory.usage_in_bytes", "1\n"),
            ],
        );
        let groups = "5:devices:/\n4:cpu,memory:/docker/0123\n0::/\n";
        assert_eq!(left_in(root, groups), Some(3010.0));
        assert_eq!(left_in(root, "4:memory:/x\n"), Some(3010.0));
        assert_eq!(left_in(root, "5:devices:/x\nno line\n"), None);
    }
}
