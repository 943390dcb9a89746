//! Names that the page gives to all scripts of its window.

use super::chromium::installed;
use super::explorer::opened;
use super::page::Page;
use serde_json::json;
use std::collections::BTreeSet;

/// Own properties of the window, and names that scripts have declared beside them.
fn globals(page: &mut Page) -> BTreeSet<String> {
    let properties = page.value("Object.getOwnPropertyNames(globalThis)");
    let declared = page.chromium.page("Runtime.globalLexicalScopeNames", json!({}));
    let names = [properties, declared["names"].clone()];
    names.into_iter().flat_map(|names| serde_json::from_value::<Vec<String>>(names).unwrap()).collect()
}

/// The page has one name, its English texts have one, and the script of its viewer has one.
#[test]
fn each_script_of_the_page_has_one_global_name() {
    let Some(program) = installed() else { return };
    let (explorer, mut page) = opened(&program);
    let of_page = globals(&mut page);
    page.open(&format!("{}/favicon.svg", explorer.origin()));
    let of_browser = globals(&mut page);
    assert!(of_browser.contains("document"), "{of_browser:?}");
    assert_eq!(of_page.difference(&of_browser).collect::<Vec<_>>(), ["ENGLISH", "asperity", "wasm_bindgen"]);
}
