//! Lines of a screen on a page.

use super::words::entries;

#[test]
fn a_screen_becomes_a_list_of_terms() {
    let text = "x.db\n  read as     COLMAP database\n  incremental starts a new model where it\n              cannot go <on>\n  joints      2\n    components 1 and 2: one pair\n  next        verify advise x.db\n                # what to match\n              verify export x.db\n                # lists\n  averaging   of pairs\n  follows     global: can place\n              some parts\n              incremental: starts anew\n              averaging of pairwise directions: all\n  time        3 ms\n";
    let html = entries(text);
    for part in [
        "<dt>read as</dt><dd><p>COLMAP database</p></dd>",
        "<dt>incremental</dt><dd><p>starts a new model where it cannot go &lt;on&gt;</p></dd>",
        "<dt>joints</dt><dd><p>2</p><p class=\"under\">components 1 and 2: one pair</p></dd>",
        "<dd><p><code>verify advise x.db</code></p><p class=\"purpose\">what to match</p>\
         <p><code>verify export x.db</code></p><p class=\"purpose\">lists</p></dd>",
        "<dt>averaging</dt><dd><p>of pairs</p></dd>",
        "<dt>follows</dt><dd><p>global: can place some parts</p><p>incremental: starts anew</p>\
         <p>averaging of pairwise directions: all</p></dd>",
    ] {
        assert!(html.contains(part), "{part}: {html}");
    }
    assert!(!html.contains("<p>x.db"), "the title is no entry");
    assert!(!html.contains("3 ms"), "a page is the same each time");
}
