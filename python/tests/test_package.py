"""The package as a whole: its types, its command line, its documentation, and what an import costs."""

import inspect
import subprocess
import sys
from importlib import metadata
from pathlib import Path

import pytest

import asperity as asp

HERE = Path(__file__).parent


def test_the_stubs_and_the_code_satisfy_a_type_checker() -> None:
    pytest.importorskip("mypy")
    command = [sys.executable, "-m", "mypy", "--config-file", "pyproject.toml"]
    ran = subprocess.run(command, cwd=HERE.parent, capture_output=True, text=True)
    assert ran.returncode == 0, ran.stdout


def test_the_stubs_agree_with_the_module() -> None:
    for name in ["matplotlib", "mypy", "xarray"]:
        pytest.importorskip(name)
    options = ["--mypy-config-file", "pyproject.toml", "--allowlist", "tests/stubtest.txt", "--ignore-disjoint-bases", "--concise"]
    ran = subprocess.run([sys.executable, "-m", "mypy.stubtest", "asperity", *options], cwd=HERE.parent, capture_output=True, text=True)
    assert ran.returncode == 0, ran.stdout + ran.stderr


def test_everything_is_documented() -> None:
    for name in asp.__all__:
        it = getattr(asp, name)
        assert inspect.getdoc(it), name
        members = vars(it).items() if inspect.isclass(it) and it.__module__ == "asperity" else ()
        for member, value in members:
            assert member.startswith("_") or inspect.getdoc(value), f"{name}.{member}"


def test_the_command_line_is_in_the_package(tmp_path: Path) -> None:
    words = "solve --indenter sine --amplitude 0.01 --points 64 --size 1 --reduced-pressure 0.1 --out run.npz"
    ran = subprocess.run([sys.executable, "-m", "asperity", *words.split()], cwd=tmp_path, capture_output=True, text=True)
    assert ran.returncode == 0 and (tmp_path / "run.npz").exists(), ran.stderr
    said = subprocess.run([sys.executable, "-m", "asperity", "--version"], capture_output=True, text=True)
    assert said.stdout.startswith("asperity ")
    refused = subprocess.run([sys.executable, "-m", "asperity", "solve"], capture_output=True, text=True)
    assert refused.returncode == 2


def test_the_distribution_says_what_it_is() -> None:
    found = metadata.distribution("asperity-contact")
    said = subprocess.run([sys.executable, "-m", "asperity", "--version"], capture_output=True, text=True).stdout
    assert found.version == asp.__version__ == said.split()[1]
    assert found.metadata["License-Expression"] == "MIT OR Apache-2.0"
    licences = {file.name: file.read_text() for file in found.files or [] if "licenses" in file.parts}
    assert set(licences) == {"LICENSE-APACHE", "LICENSE-MIT", "licences.txt"} and all(len(text) > 1000 for text in licences.values())
    classifiers = found.metadata.get_all("Classifier") or []
    assert {"Intended Audience :: Science/Research", "Programming Language :: Python :: 3.10", "Typing :: Typed"} <= set(classifiers)
    assert set(found.metadata.get_all("Provides-Extra") or []) == {"notebook", "study", "test"}
    assert found.metadata["Requires-Python"] == ">=3.10"
    assert [point.name for point in found.entry_points] == ["asperity"]


def test_an_import_leaves_alone_what_takes_long(capsys: pytest.CaptureFixture[str]) -> None:
    code = "import time; t = time.perf_counter(); import asperity, sys; t = time.perf_counter() - t; " \
        "print(round(1000 * t), 'numpy' in sys.modules, 'typing' in sys.modules)"
    printed = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout.split()
    with capsys.disabled():
        print(f"\n  import asperity: {printed[0]} ms")
    assert printed[1:] == ["False", "False"]
