//! `verify audit`, through the binary.

use crate::common::{Run, data, program, verify};
use serde_json::Value;
use std::path::Path;
use std::process::Command;

fn graph_file(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

fn lines(run: &Run) -> Vec<Value> {
    let parse = |line: &str| serde_json::from_str(line).unwrap();
    run.out.lines().map(parse).collect()
}

const SQUARE: &str = "0 1\n1 2\n2 3\n0 3\n";
const COMPLETE: &str = "0 1\n0 2\n0 3\n1 2\n1 3\n2 3\n";

#[test]
fn both_sides_agree_on_small_graphs() {
    let folder = tempfile::tempdir().unwrap();
    let square = graph_file(folder.path(), "square.txt", SQUARE);
    let complete = graph_file(folder.path(), "complete.txt", COMPLETE);
    let run = verify(&["audit", "--json", "--draws", "5", &square, &complete]);
    assert_eq!(run.code, 0, "{}{}", run.out, run.err);
    let found = lines(&run);
    for (line, verdict, components) in [
        (&found[0], "not-finite-solvable", 4),
        (&found[1], "finite-solvable", 1),
    ] {
        assert_eq!(line["float"]["verdict"], verdict);
        assert_eq!(line["float"]["components"], components);
        assert_eq!(line["exact"]["components"], components);
        assert_eq!(line["agree"], true);
        assert_eq!((&line["draws"], &line["misjudged"]), (&5.into(), &0.into()));
    }
    let margin = |k: usize| found[k]["float"]["margin_decades"].as_f64().unwrap();
    assert!(margin(0) < -5.0 && margin(1) > 0.0, "{}", run.out);
}

/// A tolerance above everything calls K4 unsolvable, at every draw.
#[test]
fn a_tolerance_that_lies_is_found_out() {
    let folder = tempfile::tempdir().unwrap();
    let complete = graph_file(folder.path(), "complete.txt", COMPLETE);
    let run = verify(&["audit", "--tolerance", "1e9", "--draws", "3", &complete]);
    assert_eq!(run.code, 1, "{}", run.out);
    assert!(run.out.contains("DISAGREE"), "{}", run.out);
    assert!(
        run.out.contains("3 of 3 misjudged (100.00 %)"),
        "{}",
        run.out
    );
}

#[test]
fn bad_options() {
    for arguments in [
        &["audit"][..],
        &["audit", "--tolerance", "nan", "x"],
        &["audit", "--tolerance=-1", "x"],
        &["audit", "--draws", "0", "x"],
        &["audit", "--claims", "x", "y"],
        &["audit", "--claims", "/nonexistent.csv"],
        &["audit", "/nonexistent"],
    ] {
        assert_eq!(verify(arguments).code, 2, "{arguments:?}");
    }
}

#[test]
fn claims_confirmed_refuted_open_and_bad() {
    let folder = tempfile::tempdir().unwrap();
    let square = graph_file(folder.path(), "square.txt", SQUARE);
    let audit = |table: &str| {
        let table = table.replace("square", &square);
        let table = graph_file(folder.path(), "claims.csv", &table);
        verify(&["audit", "--claims", &table, "--json"])
    };
    // C~ is K4 in graph6; the square is Cl.
    let run =
        audit("graph,verdict,components,rank\nC~,solvable,1,29\nCl,not-finite-solvable,4,28\n");
    assert_eq!(run.code, 0, "{}{}", run.out, run.err);
    assert!(lines(&run).iter().all(|line| line["ruling"] == "confirmed"));

    let run = audit("name,verdict,components\nsquare,,1\nsquare,solvable,\n");
    assert_eq!(run.code, 1, "{}{}", run.out, run.err);
    for line in lines(&run) {
        assert_eq!(line["ruling"], "refuted");
    }

    let run = audit("name,verdict,components,nodes\nsquare,,4,5\n");
    assert_eq!(run.code, 0);
    assert_eq!(lines(&run)[0]["ruling"], "not decidable");

    // Unknown graph, no claim, not a number: each is said, and the good row is still decided.
    let run = audit("name,verdict,components\nsquare,,4\nnobody,,1\nsquare,,\nsquare,,x\n");
    assert_eq!(run.code, 2);
    let found = lines(&run);
    assert_eq!((found.len(), &found[0]["ruling"]), (4, &"confirmed".into()));
    for (row, word) in [
        (2, "unknown graph nobody"),
        (3, "nothing is claimed"),
        (4, "not a number"),
    ] {
        // The first row is on the second line.
        let place = format!("claims.csv:{}: ", row + 1);
        let said = run.err.lines().find(|line| line.contains(&place));
        assert!(said.is_some_and(|line| line.contains(word)), "{}", run.err);
        let error = found[row - 1]["error"].as_str();
        assert!(
            error.is_some_and(|error| error.contains(word)),
            "{}",
            run.out
        );
    }
}

/// A table that may not say what its author means is refused whole, with the line: nothing of it
/// is ruled on.
#[test]
fn tables_that_are_not_understood_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let audit = |table: &str| {
        let table = graph_file(folder.path(), "claims.csv", table);
        verify(&["audit", "--claims", &table])
    };
    for (table, line, why) in [
        ("", 1, "empty"),
        ("graph,rank\n", 1, "no rows"),
        ("[]", 1, "this is JSON"),
        ("graph,rang\nC~,29\n", 1, "unknown column \"rang\""),
        ("graph,rank,Rank\nC~,29,29\n", 1, "twice"),
        ("graph,rank\nC~,29\nC~\n", 3, "1 cell, and the head has 2"),
        ("graph,rank\n\nC~,29,1\n", 3, "3 cells"),
        (
            "{\"graph\": \"C~\", \"rank\": 29}\n",
            1,
            "pandas.read_json('FILE').to_csv('claims.csv', index=False)",
        ),
    ] {
        let run = audit(table);
        assert_eq!(run.code, 2, "{table}: {}", run.out);
        assert_eq!(run.out, "", "{table}");
        let place = format!("claims.csv:{line}: ");
        assert!(run.err.contains(&place), "{table}: {}", run.err);
        assert!(run.err.contains(why), "{table}: {}", run.err);
    }
}

/// The column `model`: the 4-cycle in all models, by hand. An affine rank is four times that of R.
#[test]
fn claims_in_all_models() {
    let folder = tempfile::tempdir().unwrap();
    let audit = |rows: &str| {
        let table = format!("graph,model,verdict,rank,components\n{rows}");
        let table = graph_file(folder.path(), "claims.csv", &table);
        verify(&["audit", "--claims", &table])
    };
    let right = "Cl,,not-finite-solvable,28,4\nCl,projective,not-solvable,28,4\n\
                 Cl,calibrated,solvable,8,1\nCl,affine,not-solvable,16,4\n\
                 C~,affine,solvable,20,1\n";
    let run = audit(right);
    assert_eq!(run.code, 0, "{}{}", run.out, run.err);
    assert!(run.out.contains("5 confirmed, 0 refuted"), "{}", run.out);
    for (row, why) in [
        ("Cl,affine,,17,\n", "claimed rank 17, is 16"),
        ("Cl,affine,,4,\n", "claimed rank 4, is 16"),
        ("Cl,affine,solvable,,\n", "claimed solvable"),
        ("Cl,affine,,,1\n", "claimed components 1, is 4"),
    ] {
        let run = audit(row);
        assert_eq!(run.code, 1, "{row}: {}{}", run.out, run.err);
        let said = format!("{}{}", run.out, run.err);
        assert!(said.contains(why), "{row}: {said}");
    }
    let run = audit("Cl,plane,,16,\n");
    assert_eq!(run.code, 2, "{}", run.out);
    let said = format!("{}{}", run.out, run.err);
    let wanted = "\"plane\" is not one of projective, calibrated and affine";
    assert!(said.contains(wanted), "{said}");
}

/// Psi of docs/theory.md, Example 6.2: the published method merges what is not one component.
#[test]
fn a_disagreement_is_explained() {
    let psi = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/psi.txt");
    let psi = psi.to_str().unwrap();
    let run = verify(&["audit", psi]);
    assert_eq!(run.code, 1, "{}", run.out);
    for words in [
        "DISAGREE",
        "components 15",
        "components 12",
        "pairs that always move as one",
        "Example 6.2",
    ] {
        assert!(run.out.contains(words), "{words}: {}", run.out);
    }
    let run = verify(&["audit", "--json", psi]);
    let line = &run.json()[0];
    assert_eq!(line["agree"], false);
    assert!(line["reason"].as_str().unwrap().contains("Example 6.2"));
    let folder = tempfile::tempdir().unwrap();
    let complete = graph_file(folder.path(), "complete.txt", COMPLETE);
    let run = verify(&["audit", "--json", "--tolerance", "1e9", &complete]);
    let line = &run.json()[0];
    let reason = line["reason"].as_str().unwrap();
    assert!(
        reason.contains("wrong side of the tolerance at 1 of 1 draw"),
        "{reason}"
    );
    let run = verify(&["audit", "--json", &complete]);
    assert!(run.json()[0]["reason"].is_null());
}

/// The paper's Table 3: both methods' numbers of components, and the sizes.
#[test]
#[ignore = "needs data"]
fn table_3_is_confirmed() {
    let data = data();
    let run = Command::new(program("verify"))
        .args(["audit", "--claims", "../table3.csv"])
        .current_dir(data.join("table3"))
        .output()
        .unwrap();
    let out = String::from_utf8(run.stdout).unwrap();
    assert!(run.status.success(), "{out}");
    assert!(
        out.ends_with("29 confirmed, 0 refuted, 0 not decidable, 0 bad rows\n"),
        "{out}"
    );
}

/// A MATLAB 5 file with two symmetric adjacency matrices of doubles, by the format's
/// description: a header of 128 bytes, then a matrix element (type 14) each, of array flags
/// (class 6, double), dimensions, name and values.
fn two_matrices(folder: &Path) -> String {
    fn element(kind: u32, data: &[u8]) -> Vec<u8> {
        let mut bytes = [kind.to_le_bytes(), (data.len() as u32).to_le_bytes()].concat();
        bytes.extend(data);
        bytes.resize(bytes.len().next_multiple_of(8), 0);
        bytes
    }
    let matrix = |name: &str, pairs: &[(usize, usize)]| {
        let mut values = [0.0f64; 16];
        for &(i, j) in pairs {
            (values[4 * i + j], values[4 * j + i]) = (1.0, 1.0);
        }
        let parts = [
            element(6, &[6u32, 0].map(u32::to_le_bytes).concat()),
            element(5, &[4u32, 4].map(u32::to_le_bytes).concat()),
            element(1, name.as_bytes()),
            element(9, &values.map(f64::to_le_bytes).concat()),
        ];
        element(14, &parts.concat())
    };
    let mut file = b"MATLAB 5.0 MAT-file".to_vec();
    file.resize(124, b' ');
    file.extend([0, 1, b'I', b'M']);
    file.extend(matrix("square", &[(0, 1), (1, 2), (2, 3), (0, 3)]));
    let all = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];
    file.extend(matrix("complete", &all));
    let path = folder.join("two.mat");
    std::fs::write(&path, file).unwrap();
    path.to_str().unwrap().to_owned()
}

/// The variable and the format are taken as by the verifier itself, by every command that
/// reads graphs.
#[test]
fn the_variable_and_the_format_can_be_said() {
    let folder = tempfile::tempdir().unwrap();
    let two = two_matrices(folder.path());
    for command in ["audit", "models", "overview", "label"] {
        // Which of the two is meant has to be said.
        let run = verify(&[command, &two]);
        assert_eq!(run.code, 2, "{}", run.out);
        for (variable, pairs) in [("square", 4), ("complete", 6)] {
            let run = verify(&[
                command,
                "--json",
                "--variable",
                variable,
                "--format",
                "matlab",
                &two,
            ]);
            let json = &run.json()[0];
            assert_eq!(
                json["graph"]["edges"], pairs,
                "{command}: {}{}",
                run.out, run.err
            );
        }
        assert_eq!(verify(&[command, "--variable", "none", &two]).code, 2);
        let run = verify(&[command, "--format", "graph6", &two]);
        assert_eq!(run.code, 2, "{command}: {}", run.out);
        assert_eq!(verify(&[command, "--format", "picture", &two]).code, 2);
    }
    // Claims say themselves what their graphs are.
    let run = verify(&["audit", "--claims", "x.csv", "--format", "graph6"]);
    assert_eq!(run.code, 2);
    assert!(run.err.contains("cannot be used with"), "{}", run.err);
}

/// A row whose graph was read or decided with more than its name says is refused, with what to do; how the answer was
/// found does not matter.
#[test]
fn rows_that_rest_on_options() {
    let folder = tempfile::tempdir().unwrap();
    let weights = "from,to,weight\n0,1,9\n1,2,9\n0,2,9\n2,3,1\n3,0,9\n";
    let weights = graph_file(folder.path(), "weights.csv", weights);
    let odd = graph_file(folder.path(), "odd.txt", "a b 1 x\nb c 2\nc a 3 y z\n");
    let loops = graph_file(folder.path(), "loops.txt", "a b\nb c\nc a\nc c\n");
    let parts = graph_file(folder.path(), "parts.txt", "part 0 1 2 3\n");
    let square = graph_file(folder.path(), "square.txt", SQUARE);
    let audit = |table: &str| {
        let table = graph_file(folder.path(), "claims.csv", table);
        verify(&["audit", "--claims", &table])
    };
    let read: &[&str] = &[&weights, "--columns", "from,to,weight", "--min-weight", "2"];
    for (options, said) in [
        (read, "--columns from,to,weight --min-weight 2: write what"),
        (&[&odd, "--format", "edges"], "--format edges: write what"),
        (&[&loops, "--skip-loops"], "--skip-loops: write what"),
        (
            &[&square, "--given", &parts],
            "without which it is another claim",
        ),
    ] {
        let own = verify(&[options, &["--table=csv"]].concat());
        assert!(own.code < 2, "{options:?}: {}", own.err);
        let run = audit(&own.out);
        assert_eq!(run.code, 2, "{options:?}: {}", run.out);
        assert!(run.err.contains(said), "{options:?}: {}", run.err);
    }
    // What the refusal says to do.
    let run = verify(&[&["convert"], read].concat());
    assert_eq!(run.code, 0, "{}", run.err);
    let plain = graph_file(folder.path(), "plain.txt", &run.out);
    for how in [&[][..], &["--method", "ranks"], &["--model", "affine"]] {
        let own = verify(&[&["--table=csv", &plain], how].concat()).out;
        let run = audit(&own);
        assert!(
            run.out.contains("1 confirmed, 0 refuted, 0 not"),
            "{own}{}",
            run.out
        );
        let wrong = own.replacen(",proved,", ",proved,9", 1);
        assert_eq!(audit(&wrong).code, 1, "{wrong}");
        let run = audit(&own.replace(&plain, &weights));
        assert!(
            run.out.contains("another graph is meant"),
            "{own}{}",
            run.out
        );
    }
    for (options, why) in [
        ("[1]", "no JSON object"),
        (r#"{""mood"":""good""}"#, "--mood good"),
    ] {
        let run = audit(&format!("graph,rank,options\nBw,18,\"{options}\"\n"));
        assert_eq!(run.code, 2, "{}", run.out);
        assert!(run.err.contains(why), "{}", run.err);
    }
}

/// The program's own table, by commas, semicolons or tabs, is one of claims; so are the published ones.
#[test]
fn tables_of_the_program_are_claims() {
    let folder = tempfile::tempdir().unwrap();
    let square = graph_file(folder.path(), "=square.txt", SQUARE);
    let lines = graph_file(folder.path(), "two.g6", "Bw\nHBQkcP_\n");
    let absent = folder.path().join("absent.txt").display().to_string();
    let audit = |table: &str| {
        let table = graph_file(folder.path(), "claims.csv", table);
        verify(&["audit", "--claims", &table])
    };
    for extra in [
        &[][..],
        &["--solutions=full"],
        &["--model", "calibrated"],
        &["--model", "affine"],
    ] {
        let own = verify(&[&["--table=csv", &square, &lines], extra].concat()).out;
        for table in [own.clone(), own.replace(',', ";"), own.replace(',', "\t")] {
            let run = audit(&table);
            assert_eq!(run.code, 0, "{table}{}{}", run.out, run.err);
            assert!(
                run.out.contains("3 confirmed, 0 refuted"),
                "{table}{}",
                run.out
            );
        }
        let wrong = own.replacen(",proved,4,", ",proved,3,", 1);
        if wrong != own {
            assert_eq!(audit(&wrong).code, 1, "{wrong}");
        }
    }
    // A graph that had no answer claims nothing; the others are ruled on.
    let own = verify(&["--table=csv", &square, &absent]).out;
    let run = audit(&own);
    assert_eq!(run.code, 2, "{own}{}", run.out);
    assert!(
        run.out.contains("1 confirmed") && run.err.contains("had no answer"),
        "{}{}",
        run.out,
        run.err
    );

    let published = crate::common::root().join("certificates/n11-finite-solvable.tsv");
    let published = std::fs::read_to_string(published).unwrap();
    let mut rows: Vec<&str> = published.lines().take(1).collect();
    rows.extend(published.lines().skip(1).step_by(4000));
    let run = audit(&format!("{}\n", rows.join("\n")));
    assert_eq!(run.code, 0, "{}{}", run.out, run.err);
    assert!(run.out.contains("5 confirmed, 0 refuted"), "{}", run.out);
    // Another number of solutions than the published one.
    let wrong = rows[1].trim_end_matches(|c: char| c.is_ascii_digit());
    let run = audit(&format!("{}\n{wrong}77\n", rows[0]));
    assert!(
        run.out.contains("claimed solutions 77"),
        "{}{}",
        run.out,
        run.err
    );
}

/// Every column that names a graph takes paths, and `graph` a line of graph6 as well; a name that only looks like one
/// is none.
#[test]
fn columns_that_name_a_graph() {
    let folder = tempfile::tempdir().unwrap();
    let square = graph_file(folder.path(), "square.txt", SQUARE);
    let two = graph_file(folder.path(), "two.g6", "Bw\nCl\n") + ":2";
    for (column, name, code) in [
        ("graph", &*square, 0),
        ("graph", &two, 0),
        ("graph", "Cl", 0),
        ("graph6", "Cl", 0),
        ("file", &square, 0),
        ("name", &two, 0),
        ("name", "Cl", 2),
        ("graph6", &square, 2),
    ] {
        let table = format!("{column},components\n{name},4\n");
        let table = graph_file(folder.path(), "claims.csv", &table);
        let run = verify(&["audit", "--claims", &table]);
        assert_eq!(run.code, code, "{column} {name}: {}{}", run.out, run.err);
    }
}
