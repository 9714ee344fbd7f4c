//! A real browser without a window.

use std::path::Path;
use std::process::{Command, Stdio};

/// Chromium, or what goes by its name.
pub(crate) struct Browser(String);

/// How large a screen is, and what points at it.
#[derive(Clone, Copy)]
pub(crate) enum Screen {
    Desk,
    Phone,
}

impl Browser {
    /// The browser that is installed here.
    pub(crate) fn find() -> Self {
        for name in ["chromium", "chromium-browser", "google-chrome", "chrome"] {
            let found = Command::new(name)
                .arg("--version")
                .stdout(Stdio::null())
                .stderr(Stdio::null())
                .status();
            if found.is_ok_and(|status| status.success()) {
                return Self(name.into());
            }
        }
        super::absent("no Chromium is installed")
    }

    /// The elements of a page as they are when all has run, and what went to standard error; `view` is
    /// the fragment of the address.
    pub(crate) fn dump(&self, path: &Path, view: &str) -> (String, String) {
        self.dump_as(path, view, Screen::Desk)
    }

    /// The same on a screen.
    pub(crate) fn dump_as(&self, path: &Path, view: &str, screen: Screen) -> (String, String) {
        let profile = tempfile::tempdir().unwrap();
        let output = Command::new(&self.0)
            .args([
                "--headless",
                "--no-sandbox",
                "--disable-gpu",
                "--disable-dev-shm-usage",
            ])
            .args(["--enable-logging=stderr", "--dump-dom"])
            .args(match screen {
                Screen::Desk => &["--window-size=1200,1600"][..],
                // The pointer is a finger.
                Screen::Phone => &[
                    "--window-size=390,844",
                    "--blink-settings=primaryPointerType=2,availablePointerTypes=2",
                    // Names have their size once a frame is drawn.
                    "--virtual-time-budget=2000",
                ],
            })
            .arg(format!("--user-data-dir={}", profile.path().display()))
            .arg(format!("file://{}#{view}", path.display()))
            .stdin(Stdio::null())
            .output()
            .unwrap();
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        let text = |bytes| String::from_utf8(bytes).unwrap();
        (text(output.stdout), text(output.stderr))
    }
}
