//! Certificates of contradictions (docs/contradictions.md): each condition is broken, and mutants are about the
//! numbers that they have. `contradictions/` is made by `contradict.py`, which finds cycles and motions by itself.

use serde_json::{Value, json};
use std::sync::LazyLock;
use viewcert_check::{Answer, Certificate, Database, Limits, Row, VerifiedContradictions};

static CERTIFICATE: LazyLock<Value> = LazyLock::new(|| {
    serde_json::from_str(include_str!("contradictions/certificate.json")).unwrap()
});
static DATABASE: LazyLock<Database> = LazyLock::new(|| Database::new(rows()).unwrap());

/// The rows of the four tables.
fn rows() -> [Vec<Row>; 4] {
    let tables: Value = serde_json::from_str(include_str!("contradictions/rows.json")).unwrap();
    ["cameras", "images", "keypoints", "two_view_geometries"].map(|table| {
        let rows = tables[table].as_array().unwrap().iter();
        let row = |row: &Value| {
            let values = row.as_array().unwrap().iter();
            let texts = values.clone().filter_map(Value::as_str);
            let blobs = texts.map(|text| match table {
                "images" => text.as_bytes().to_vec(),
                _ => bytes(text),
            });
            (values.filter_map(Value::as_i64).collect(), blobs.collect())
        };
        rows.map(row).collect()
    })
}

fn bytes(digits: &str) -> Vec<u8> {
    let two = (0..digits.len()).step_by(2);
    two.map(|k| u8::from_str_radix(&digits[k..k + 2], 16).unwrap())
        .collect()
}

fn check(document: &Value, database: Option<&Database>) -> Result<VerifiedContradictions, String> {
    let text = document.to_string();
    let certificate = Certificate::parse(text.as_bytes());
    let checked = certificate.and_then(|one| one.check(None, database, &Limits::default()));
    match checked.map_err(|failure| failure.to_string())? {
        Answer::Contradictions(verified) => Ok(*verified),
        other => panic!("{other}"),
    }
}

/// A reason, and a change of something that gives it.
type Case<'a, T> = (&'a str, fn(&mut T));

/// Each change is rejected for its reason.
fn all_rejected(document: &Value, database: Option<&Database>, cases: &[Case<Value>]) {
    for (reason, change) in cases {
        let mut changed = document.clone();
        change(&mut changed);
        assert_ne!(changed, *document, "{reason}");
        if database.is_some() {
            check(&changed, None).unwrap_or_else(|other| panic!("{reason}: {other}"));
        }
        let found = check(&changed, database).unwrap_err();
        assert!(found.contains(reason), "{found}, and not {reason}");
    }
}

/// The motions alone: what packings say may hold of other motions too.
fn motions() -> Value {
    let mut document = CERTIFICATE.clone();
    (document["packings"], document["upper"]) = (json!([]), json!([]));
    document
}

#[test]
fn what_is_right_is_verified_and_says_of_which_numbers() {
    let verified = check(&CERTIFICATE, None).unwrap();
    let text = verified.to_string();
    let lines: Vec<_> = text.lines().collect();
    let hash = CERTIFICATE["database"].as_str().unwrap();
    assert_eq!(
        lines[0],
        format!("numbers: those written here, 7 images, 10 pairs; database with SHA-256 {hash}")
    );
    assert_eq!(
        lines[3],
        "contradictions: at least 2 of 10 pairs are off by more than 8 degrees, or their directions by more than 20, \
         if 4 others are right within 8 degrees (proof), about the numbers written here"
    );
    let bound = check(&CERTIFICATE, Some(&DATABASE)).unwrap();
    assert!(bound.bound && !verified.bound);
    assert!(
        bound
            .to_string()
            .lines()
            .all(|line| line.contains("of this database"))
    );
    let last = "rotations: all pairs but 4 agree within 10 degrees (proof), of this database\n";
    assert!(bound.to_string().ends_with(last));
}

#[test]
fn each_condition_about_numbers_is_needed() {
    all_rejected(
        &CERTIFICATE,
        None,
        &[
            ("`format` is not", |d| {
                d["format"] = json!("viewcert certificate of contradictions")
            }),
            ("version 1 is not read any more", |d| {
                d["version"] = json!(1)
            }),
            ("`specific` is not a question", |d| {
                d["question"] = json!("specific")
            }),
            ("no images", |d| d["images"] = json!([])),
            ("one name", |d| d["images"][1] = json!("1.jpg")),
            ("64 digits", |d| d["database"] = json!("0".repeat(63))),
            ("64 digits", |d| d["database"] = json!("G".repeat(64))),
            ("of no database", |d| d["database"] = json!(null)),
            ("no two images", |d| d["pairs"][0]["ends"] = json!([0, 0])),
            ("no two images", |d| d["pairs"][0]["ends"] = json!([0, 7])),
            ("zeros alone", |d| d["pairs"][0]["q"] = json!([0, 0, 0, 0])),
            ("zeros alone", |d| d["excluded"][0]["t"] = json!([0, 0, 0])),
            ("another configuration", |d| {
                d["pairs"][0]["configuration"] = json!(null)
            }),
            ("another configuration", |d| {
                (d["database"], d["excluded"]) = (json!(null), json!([]));
            }),
            ("there twice", |d| d["excluded"][0]["ends"] = json!([1, 0])),
            ("theta is not", |d| d["packings"][0]["theta"] = json!(90)),
            ("phi is not", |d| d["packings"][2]["phi"] = json!(7)),
            ("phi is not", |d| d["packings"][2]["phi"] = json!(90)),
            ("-1 is out of range", |d| {
                d["packings"][0]["cycles"][0]["weight"] = json!(-1)
            }),
            ("is missing", |d| {
                d["packings"][0].as_object_mut().unwrap().remove("assumed");
            }),
            ("for witnesses alone", |d| {
                d["packings"][2]["phi"] = json!(null)
            }),
            ("for witnesses alone", |d| {
                d["packings"][0]["phi"] = json!(20)
            }),
            ("denominator is zero", |d| {
                d["packings"][0]["denominator"] = json!(0)
            }),
            ("no increasing list", |d| {
                d["packings"][2]["assumed"] = json!([4, 0, 7, 9])
            }),
            ("no increasing list", |d| {
                d["packings"][2]["assumed"] = json!([0, 4, 7, 10])
            }),
            ("assumed right", |d| {
                d["packings"][1]["assumed"] = json!([1, 2, 7])
            }),
            ("carries 2", |d| {
                d["packings"][1]["cycles"][0]["weight"] = json!(2)
            }),
            ("the weights prove 1", |d| {
                d["packings"][0]["at_least"] = json!(2)
            }),
            ("two steps", |d| {
                d["packings"][0]["cycles"][0]["walk"] = json!([[1, 1]])
            }),
            ("sum to 180", |d| d["packings"][0]["theta"] = json!(60)),
            ("assumed_within", |d| {
                d["packings"][2]["assumed_within"] = json!(0)
            }),
            ("assumed_within", |d| {
                d["packings"][2]["assumed_within"] = json!(8001)
            }),
            // 44 degrees are not more than 30 and two times 7.
            ("turns by 44 degrees or less", |d| {
                d["packings"][3]["assumed_within"] = json!(7000)
            }),
            ("expected a string", |d| d["program"] = json!(1)),
            ("does not belong", |d| d["more"] = json!(1)),
            ("no pair -1", |d| {
                d["packings"][0]["cycles"][0]["walk"][0][0] = json!(-1)
            }),
            ("no pair 10", |d| {
                d["packings"][0]["cycles"][0]["walk"][0][0] = json!(10)
            }),
            ("taken twice", |d| {
                d["packings"][0]["cycles"][0]["walk"][1] = json!([1, -1])
            }),
            ("no sense", |d| {
                d["packings"][0]["cycles"][0]["walk"][0][1] = json!(2)
            }),
            ("not closed", |d| {
                d["packings"][0]["cycles"][0]["walk"][0][1] = json!(-1)
            }),
            ("turns by 30 degrees or less", |d| {
                d["packings"][1]["cycles"][0]["walk"] = json!([[7, 1], [9, 1], [8, -1]]);
            }),
            ("the witness is zero", |d| {
                d["packings"][2]["cycles"][1]["witness"] = json!([0, 0, 0])
            }),
            ("phi + h theta is 95", |d| {
                let cycle = d["packings"][2]["cycles"][1].take();
                d["packings"][2]["cycles"] = json!([cycle]);
                (d["packings"][2]["theta"], d["packings"][2]["phi"]) = (json!(45), json!(50));
            }),
            ("has no vector", |d| d["pairs"][9]["t"] = json!(null)),
            ("near enough", |d| {
                d["packings"][2]["cycles"][1]["witness"] = json!([-926_665, -483_048, -86_418])
            }),
            ("near enough", |d| {
                d["packings"][2]["cycles"][1]["witness"] = json!([1, 0, 9])
            }),
            ("theta is not", |d| d["upper"][0]["theta"] = json!(0)),
            ("for each image", |d| {
                d["upper"][0]["rotations"] = json!([[1, 0, 0, 0]])
            }),
            ("for each image", |d| {
                d["upper"][0]["rotations"][0] = json!([0, 0, 0, 0])
            }),
            ("4 pairs do not agree", |d| {
                d["upper"][0]["at_most"] = json!(3)
            }),
        ],
    );
}

#[test]
fn each_condition_about_the_database_is_needed() {
    all_rejected(
        &motions(),
        Some(&DATABASE),
        &[
            ("the database has the SHA-256", |d| {
                d["database"] = json!("0".repeat(64))
            }),
            ("no image 0.jpg", |d| d["images"][0] = json!("0.jpg")),
            ("are no pair there", |d| {
                let pair =
                    json!({"ends": [6, 1], "configuration": 2, "q": [1, 0, 0, 0], "t": null});
                d["pairs"].as_array_mut().unwrap().push(pair);
            }),
            ("cannot be checked", |d| {
                let pair =
                    json!({"ends": [0, 6], "configuration": 2, "q": [1, 0, 0, 0], "t": null});
                d["pairs"].as_array_mut().unwrap().push(pair);
            }),
            ("is not listed", |d| d["excluded"] = json!([])),
            ("the configuration is 2", |d| {
                d["pairs"][0]["configuration"] = json!(3)
            }),
            ("by qvec is excluded", |d| {
                let pair = d["pairs"].as_array_mut().unwrap().remove(3);
                d["excluded"].as_array_mut().unwrap().push(pair);
            }),
            ("not qvec", |d| d["pairs"][3]["q"][1] = json!(1)),
            ("not tvec", |d| d["pairs"][3]["t"] = json!([1, 0, 0])),
            ("not tvec", |d| d["pairs"][6]["t"] = json!([1, 0, 0])),
            ("by E has no vector", |d| d["pairs"][0]["t"] = json!(null)),
            ("not that of E", |d| d["pairs"][0]["q"][1] = json!(1)),
            ("too few points", |d| {
                let t: Vec<i64> = serde_json::from_value(d["pairs"][0]["t"].take()).unwrap();
                d["pairs"][0]["t"] = t.iter().map(|x| -x).collect();
            }),
            ("too few points", |d| {
                let pair = d["excluded"].as_array_mut().unwrap().remove(0);
                d["pairs"].as_array_mut().unwrap().push(pair);
            }),
            ("more than half", |d| {
                let pair = d["pairs"].as_array_mut().unwrap().remove(0);
                d["excluded"].as_array_mut().unwrap().push(pair);
            }),
        ],
    );
}

/// Each change of the database takes the first pair's measurement away; without qvec nothing stands for it.
#[test]
fn what_a_measurement_needs() {
    let cases: [fn(&mut [Vec<Row>; 4]); 22] = [
        |tables| tables[3][0].0[1] = 14,
        |tables| tables[3][0].0[2] = 4,
        |tables| tables[3][0].1[0].truncate(120),
        |tables| tables[3][0].1[1].truncate(64),
        |tables| tables[3][0].1[1].fill(0),
        |tables| tables[3][0].1[1][64..].copy_from_slice(&3.0_f64.to_le_bytes()),
        |tables| tables[3][0].1[1][64..].copy_from_slice(&f64::NAN.to_le_bytes()),
        |tables| tables[2][0].0[2] = 1,
        |tables| tables[2][0].0[1] -= 1,
        |tables| tables[2][0].1[0][..4].copy_from_slice(&f32::NAN.to_le_bytes()),
        |tables| tables[3][0].1[0][..4].fill(255),
        |tables| tables[0][0].0[1] = 5,
        |tables| tables[0][0].0[2] = 0,
        // Behind the principal points of these models stands distortion.
        |tables| tables[0][0].0[1] = 2,
        |tables| {
            tables[0][0].0[1] = 3;
            let more = 0.01_f64.to_le_bytes();
            tables[0][0].1[0].extend(more);
        },
        |tables| tables[0][0].1[0][24..].copy_from_slice(&f64::INFINITY.to_le_bytes()),
        |tables| drop(tables[2].remove(0)),
        |tables| tables[2][1].1[0][4..8].copy_from_slice(&f32::INFINITY.to_le_bytes()),
        |tables| tables[3][0].1[1][..8].copy_from_slice(&f64::INFINITY.to_le_bytes()),
        |tables| tables[0][0].1[0].truncate(24),
        |tables| tables[0][0].1[0][..8].copy_from_slice(&(-800.0_f64).to_le_bytes()),
        |tables| drop(tables[0].remove(0)),
    ];
    for (k, change) in cases.into_iter().enumerate() {
        let mut tables = rows();
        assert_eq!(
            tables[3][0].0[0], 2_147_483_649,
            "the pair of the first two images"
        );
        tables[3].iter_mut().for_each(|row| row.1[2].clear());
        change(&mut tables);
        let database = Database::new(tables).unwrap();
        let found = rebound(&motions(), &database).unwrap_err();
        let reason = "images [1, 2]: the pair cannot be checked";
        assert!(found.contains(reason), "change {k}: {found}");
    }
}

/// The images of a row are in the order of its number.
#[test]
fn a_pair_that_is_numbered_the_other_way_is_no_measurement() {
    let mut tables = rows();
    tables[3][0].0[0] = 2 * 2_147_483_647 + 1;
    let database = Database::new(tables).unwrap();
    let found = rebound(&motions(), &database).unwrap_err();
    assert!(found.contains("[1, 2]) are no pair there"), "{found}");
    let mut document = motions();
    document["pairs"].as_array_mut().unwrap().remove(0);
    rebound(&document, &database).unwrap();
}

/// What is verified once the certificate has the hash of this database.
fn rebound(document: &Value, database: &Database) -> Result<VerifiedContradictions, String> {
    let mut document = document.clone();
    let found = check(&document, Some(database)).unwrap_err();
    document["database"] = json!(found.split("SHA-256 ").nth(1).unwrap());
    check(&document, Some(database))
}

#[test]
fn qvec_stands_for_e_in_configuration_2_only() {
    let mut tables = rows();
    tables[3].iter_mut().for_each(|row| row.1[1].clear());
    let database = Database::new(tables).unwrap();
    // The pair that is excluded by E, and those of configuration 2.
    let mut document = motions();
    let mut excluded = document["excluded"][0].take();
    (excluded["t"], excluded["q"]) = (json!(null), json!([401, 82, -75, -32]));
    let pairs = document["pairs"].as_array_mut().unwrap();
    pairs.push(excluded);
    pairs.retain(|pair| pair["configuration"] == 2);
    document["excluded"] = json!([]);
    rebound(&document, &database).unwrap();
    let pairs = document["pairs"].as_array_mut().unwrap();
    pairs.last_mut().unwrap()["q"] = json!([401, 82, -75, -33]);
    let found = rebound(&document, &database).unwrap_err();
    let reason = "images [1, 5]: the quaternion is not qvec";
    assert!(found.contains(reason), "{found}");
}

#[test]
fn rows_that_are_no_table_are_refused() {
    let cases: [Case<[Vec<Row>; 4]>; 4] = [
        ("one name", |tables| tables[1][1].1[0] = b"1.jpg".to_vec()),
        ("no UTF-8", |tables| tables[1][1].1[0] = vec![255]),
        ("there twice", |tables| tables[3].push(tables[3][0].clone())),
        ("other columns", |tables| tables[0][0].0.truncate(2)),
    ];
    for (reason, change) in cases {
        let mut tables = rows();
        change(&mut tables);
        let found = Database::new(tables).unwrap_err();
        assert!(found.reason.contains(reason), "{found}");
    }
}

#[test]
fn limits_are_kept() {
    let certificate = Certificate::parse(CERTIFICATE.to_string().as_bytes()).unwrap();
    for operations in [1 << 15, 1 << 20] {
        let limits = Limits {
            operations,
            ..Limits::default()
        };
        let found = certificate
            .check(None, Some(&DATABASE), &limits)
            .unwrap_err();
        assert!(found.to_string().contains("--max-operations"), "{found}");
    }
}
