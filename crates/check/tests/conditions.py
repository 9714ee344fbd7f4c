#!/usr/bin/env python3
"""Is there a test for each condition? Takes the conditions away, one at a time, and runs the tests.

    conditions.py [FILE:LINE ...]     all conditions, or some; e.g. crates/check/src/pivots.rs:22

The checker is copied to target/mutants and built once, with a switch in every `ensure!` (and in the
calls that refuse a file or compare with a limit): the environment variable CONDITION_OFF names the
one that does not reject. Prints the conditions that no test misses; README.md says why that is as
it should be. Exit code 1 if there are others.
"""
import json
import os
import re
import shutil
import subprocess
import sys

ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../.."))
COPY = os.path.join(ROOT, "target/mutants")
SWITCH = """
/// Whether the condition in this place is switched off.
pub(crate) fn is_off(file: &str, line: u32) -> bool {
    std::env::var("CONDITION_OFF").is_ok_and(|place| place == format!("{file}:{line}"))
}
"""
CALL = re.compile(r"^( *)(refuse\(.*\)\?;|[a-z_.]*meter\.allow_\w+\(.*\)\?;)$", re.M)


def argued():
    """The conditions without a test, by their texts: the first column of the table in README.md."""
    with open(os.path.join(ROOT, "crates/check/tests/README.md"), encoding="utf-8") as file:
        return re.findall(r"^\| `(.*?)` \|", file.read(), re.M)


def copy():
    for part in ("crates/check", "docs"):
        shutil.copytree(os.path.join(ROOT, part), os.path.join(COPY, part), dirs_exist_ok=True)
    shutil.copy(os.path.join(ROOT, "Cargo.lock"), COPY)
    with open(os.path.join(ROOT, "Cargo.toml"), encoding="utf-8") as file:
        manifest = file.read()
    workspace = manifest[:manifest.index("\n[package]")]
    with open(os.path.join(COPY, "Cargo.toml"), "w", encoding="utf-8") as file:
        workspace = re.sub(r"^(exclude|default-members).*\n", "", workspace, flags=re.M)
        file.write(re.sub(r"^members = .*$", 'members = ["crates/check"]', workspace, flags=re.M))


def sources():
    for folder, _, names in sorted(os.walk(os.path.join(COPY, "crates/check/src"))):
        for name in sorted(names):
            if name.endswith(".rs") and name != "tests.rs":
                yield os.path.join(folder, name)


def switch():
    """Puts the switches in; returns the places with the texts there."""
    places = {}
    for path in sources():
        with open(path, encoding="utf-8") as file:
            text = file.read()
        name = os.path.relpath(path, COPY)
        if name.endswith("rejection.rs"):
            text = text.replace("if !$condition {",
                                "if !$condition && !$crate::rejection::is_off(file!(), line!()) {")
            assert "is_off" in text
            text += SWITCH
        else:
            for found in re.finditer(r"\bensure!\(", text):
                line = text.count("\n", 0, found.start()) + 1
                message = re.search(r'"((?:[^"\\]|\\.)*)"', text[found.end():], re.S)
                places[f"{name}:{line}"] = message[1].split("\\\n")[0].strip()
            for found in CALL.finditer(text):
                line = text.count("\n", 0, found.start()) + 1
                places[f"{name}:{line}"] = found[2]
            text = CALL.sub(r"\1if !crate::rejection::is_off(file!(), line!()) { \2 }", text)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
    return places


def build():
    environment = {**os.environ, "CARGO_PROFILE_DEV_OPT_LEVEL": "1", "CARGO_TARGET_DIR": os.path.join(COPY, "target")}
    run = subprocess.run(["cargo", "test", "-p", "viewcert-check", "--features", "program", "--no-run", "--message-format=json"],
                         cwd=COPY, env=environment, stdout=subprocess.PIPE, check=True, text=True)
    messages = [json.loads(line) for line in run.stdout.splitlines() if line.startswith("{")]
    binaries = {message["target"]["name"]: message["executable"] for message in messages
                if message.get("executable") and message["profile"]["test"] and message["target"]["kind"] != ["bin"]}
    assert sorted(binaries) == ["all", "program", "viewcert_check"], binaries
    # File by file, so that the first that fails ends it.
    with open(os.path.join(COPY, "crates/check/tests/all.rs"), encoding="utf-8") as file:
        files = re.findall(r"^mod (\w+);", file.read(), re.M)
    steps = [[binaries["all"], f"{name}::"] for name in files if name != "changes"]
    return [[binaries["viewcert_check"]], *steps, [binaries["program"]]]


def passes(step, place):
    environment = {**os.environ, "CONDITION_OFF": place, "RUST_BACKTRACE": "0"}
    try:
        run = subprocess.run(step, cwd=os.path.join(COPY, "crates/check"), env=environment, timeout=300,
                             stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    except subprocess.TimeoutExpired:
        return False
    return run.returncode == 0


def main():
    copy()
    places = switch()
    steps = build()
    assert all(passes(step, "none") for step in steps), "the tests fail in any case"
    chosen, excused, bad = sys.argv[1:] or sorted(places), argued(), 0
    for place in chosen:
        if all(passes(step, place) for step in steps):
            known = places[place] in excused
            bad += not known
            print(f"{'argued' if known else 'NO TEST'}: {place}: {places[place]}", flush=True)
    print(f"{len(chosen)} conditions, {bad} without a test and without a reason")
    sys.exit(bad > 0)


if __name__ == "__main__":
    main()
