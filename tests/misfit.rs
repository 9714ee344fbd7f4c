//! `verify merge`: models that contradict each other, and what points of both leave free.

use crate::common::schema::keeps_to;
use crate::common::{Run, data, verify};
use std::fs;
use std::path::Path;

type Vector = [f64; 3];

/// A world that a model lies in: by a quarter turn about the third axis, a scale and a translation.
#[derive(Clone, Copy)]
struct World {
    scale: f64,
    at: Vector,
    is_turned: bool,
}

const HERE: World = World {
    scale: 1.0,
    at: [0.0; 3],
    is_turned: false,
};
const THERE: World = World {
    scale: 2.5,
    at: [3.0, -7.0, 11.0],
    is_turned: true,
};

impl World {
    fn of(self, [x, y, z]: Vector) -> Vector {
        let turned = if self.is_turned {
            [-y, x, z]
        } else {
            [x, y, z]
        };
        [0, 1, 2].map(|k| self.scale * turned[k] + self.at[k])
    }

    /// Rotation and translation of a camera that looks along the axes of the first world.
    fn pose(self, centre: Vector) -> [f64; 7] {
        let [x, y, z] = self.of(centre);
        let half = 0.5f64.sqrt();
        match self.is_turned {
            true => [half, 0.0, 0.0, -half, -y, x, -z],
            false => [1.0, 0.0, 0.0, 0.0, -x, -y, -z],
        }
    }
}

/// An image: its number, its place, and which point each feature sees.
struct Image {
    id: u32,
    name: String,
    centre: Vector,
    seen: Vec<Option<usize>>,
}

fn image(k: u32, centre: Vector) -> Image {
    Image {
        id: k + 1,
        name: format!("{k:02}.jpg"),
        centre,
        seen: Vec::new(),
    }
}

/// Images on a bent line.
fn walk(images: std::ops::Range<u32>) -> Vec<Image> {
    let place = |k: u32| [f64::from(k), f64::from(k * k) / 9.0, f64::from(k % 3)];
    images.map(|k| image(k, place(k))).collect()
}

/// Writes a model of images and points as they lie in a world. Points without views are left out.
fn write(folder: &Path, world: World, images: &[Image], points: &[Vector]) {
    fs::create_dir_all(folder).unwrap();
    let (mut list, mut tracks) = (String::new(), vec![String::new(); points.len()]);
    for Image {
        id,
        name,
        centre,
        seen,
    } in images
    {
        let pose = world.pose(*centre).map(|x| x.to_string()).join(" ");
        let features = seen.iter().map(|point| match point {
            Some(point) => format!("1 2 {}", point + 1),
            None => "1 2 -1".to_owned(),
        });
        let features: Vec<String> = features.collect();
        list += &format!("{id} {pose} 1 {name}\n{}\n", features.join(" "));
        for (k, point) in seen.iter().enumerate() {
            if let Some(point) = point {
                tracks[*point] += &format!(" {id} {k}");
            }
        }
    }
    let lines = (1..)
        .zip(points)
        .zip(tracks)
        .filter(|(_, track)| !track.is_empty());
    let lines = lines.map(|((id, point), track)| {
        let place = world.of(*point).map(|x| x.to_string()).join(" ");
        format!("{id} {place} 9 9 9 0.5{track}\n")
    });
    fs::write(folder.join("cameras.txt"), "1 PINHOLE 9 9 8 8 4 4\n").unwrap();
    fs::write(folder.join("images.txt"), list).unwrap();
    fs::write(folder.join("points3D.txt"), lines.collect::<String>()).unwrap();
}

/// The program on two models of a folder, and what else there is.
fn merge(at: &Path, more: &[&str]) -> Run {
    let [one, other] = ["one", "other"].map(|name| at.join(name).to_str().unwrap().to_owned());
    verify(&[&["merge", &one, &other], more].concat())
}

fn names(found: &serde_json::Value) -> Vec<&str> {
    let disagree = found["misfit"]["disagree"].as_array().unwrap();
    disagree
        .iter()
        .map(|one| one["image"].as_str().unwrap())
        .collect()
}

#[test]
fn models_that_contradict_each_other_are_told_from_those_that_agree() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    write(&at.join("one"), HERE, &walk(0..10), &[]);
    // How many images lie elsewhere, and whether that many may.
    for (moved, code) in [(0, 0), (1, 0), (2, 1), (3, 1)] {
        let mut images = walk(2..12);
        for image in images.iter_mut().take(moved) {
            image.centre[2] += 9.0;
        }
        write(&at.join("other"), THERE, &images, &[]);
        let found = merge(at, &["--json"]);
        assert_eq!(found.code, code, "{moved}: {}{}", found.out, found.err);
        let line = keeps_to("merge", &found, &["misfit", "determined"]).remove(0);
        assert_eq!(
            (&line["determined"], line["misfit"]["agree"] == true),
            (&true.into(), code == 0)
        );
        let mut bad = names(&line);
        bad.sort_unstable();
        assert_eq!(bad, ["02.jpg", "03.jpg", "04.jpg"][..moved], "{line}");
        if moved == 0 {
            assert!(
                line["misfit"]["images_off"].as_f64().unwrap() < 1e-9,
                "{line}"
            );
            assert!((line["misfit"]["similarity"]["scale"].as_f64().unwrap() - 2.5).abs() < 1e-9);
        }
        let said = merge(at, &[]).out;
        let words = match code {
            0 => [
                "yes: rotation",
                "the models agree",
                "measured, not proved",
                "next        ",
            ],
            _ => [
                "no: the models share enough",
                "contradict each other",
                "measured, not proved",
                "verify split",
            ],
        };
        words
            .iter()
            .for_each(|word| assert!(said.contains(word), "{word}: {said}"));
        assert!(!said.contains("agree (proved"), "{said}");
    }
    // An image that is turned, at its place.
    write(&at.join("other"), HERE, &walk(0..3), &[]);
    let path = at.join("other/images.txt");
    let turned = fs::read_to_string(&path).unwrap();
    let turned = turned.replacen("1 1 0 0 0 -0 -0 -0 1 00", "1 0 1 0 0 0 0 0 1 00", 1);
    fs::write(&path, turned).unwrap();
    let found = merge(at, &["--json"]);
    let line = &found.json()[0];
    assert_eq!((found.code, names(line)), (1, vec!["00.jpg"]), "{line}");
    assert_eq!(line["misfit"]["disagree"][0]["turned"], 180.0);
}

#[test]
fn points_of_both_are_compared_where_images_say_too_little() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let points: Vec<Vector> = (0..12u32)
        .map(|k| {
            [
                f64::from(k % 4),
                f64::from(k % 3),
                5.0 + f64::from(k * k % 7),
            ]
        })
        .collect();
    let seeing = |images: std::ops::Range<u32>| {
        let mut images = walk(images);
        images
            .iter_mut()
            .for_each(|image| image.seen = (0..12).map(Some).collect());
        images
    };
    write(&at.join("one"), HERE, &seeing(0..3), &points);
    for (moved, code) in [(0, 0), (4, 0), (8, 1)] {
        let mut other = points.clone();
        for (k, point) in other.iter_mut().enumerate().take(moved) {
            point[k % 3] += 4.0 + k as f64;
        }
        // One image of both.
        write(&at.join("other"), THERE, &seeing(2..5), &other);
        let found = merge(at, &["--json"]);
        let line = &found.json()[0];
        assert_eq!(found.code, code, "{moved}: {line}");
        assert_eq!(line["shared_images"], serde_json::json!(["02.jpg"]));
        assert_eq!(line["misfit"]["points"], 12);
        assert_eq!(line["misfit"]["points_disagree"], moved, "{line}");
    }
}

/// Models without an image in common, and a database in which each of 12 tracks leads from the one to the
/// other.
#[test]
fn tracks_of_the_database_are_compared_too() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let path = at.join("database.db");
    let database = rusqlite::Connection::open(&path).unwrap();
    let tables = "create table images (image_id integer primary key, name text);
        create table keypoints (image_id integer primary key, rows integer, cols integer, data blob);
        create table two_view_geometries (pair_id integer primary key, rows integer, cols integer, data blob,
            config integer);";
    database.execute_batch(tables).unwrap();
    let features = 20u32;
    for k in 0..6u32 {
        let row = (k + 1, format!("{k:02}.jpg"));
        database
            .execute("insert into images values (?, ?)", row)
            .unwrap();
        let keypoints = (k + 1, features, 2, vec![0u8; 8 * features as usize]);
        database
            .execute("insert into keypoints values (?, ?, ?, ?)", keypoints)
            .unwrap();
    }
    // Tracks 0 to 11 go through all images, in the feature of the same number; the others through images of
    // one side.
    for a in 0..6u32 {
        for b in a + 1..6 {
            let count = if (a < 3) == (b < 3) { features } else { 12 };
            let matches: Vec<u8> = (0..count)
                .flat_map(|k| [k, k].map(u32::to_le_bytes))
                .flatten()
                .collect();
            let pair = i64::from(a + 1) * 2_147_483_647 + i64::from(b + 1);
            let row = (pair, count, 2, matches, 2);
            database
                .execute(
                    "insert into two_view_geometries values (?, ?, ?, ?, ?)",
                    row,
                )
                .unwrap();
        }
    }
    drop(database);
    let points: Vec<Vector> = (0..features)
        .map(|k| {
            [
                f64::from(k % 5),
                f64::from(k * k % 11),
                5.0 + f64::from(k * 7 % 13),
            ]
        })
        .collect();
    let seeing = |images: std::ops::Range<u32>| {
        let mut images = walk(images);
        let all = || (0..features as usize).map(Some).collect();
        images.iter_mut().for_each(|image| image.seen = all());
        images
    };
    write(&at.join("one"), HERE, &seeing(0..3), &points);
    let database = path.to_str().unwrap();
    for (moved, code) in [(0, 0), (3, 0), (9, 1)] {
        let mut other = points.clone();
        for (k, point) in other.iter_mut().enumerate().take(moved) {
            point[k % 3] += 8.0 + k as f64;
        }
        write(&at.join("other"), THERE, &seeing(3..6), &other);
        let found = merge(at, &[database, "--min-inliers", "10", "--json"]);
        let line = keeps_to("merge", &found, &["misfit"]).remove(0);
        assert_eq!(found.code, code, "{moved}: {line}");
        assert_eq!(line["determined"], true);
        assert_eq!(line["misfit"]["images"], 0);
        assert_eq!(line["misfit"]["points"], 12, "{line}");
        let bad = line["misfit"]["points_disagree"].as_u64().unwrap() as usize;
        // Where most are wrong, chance may take one or two of these to their places.
        assert!(
            (moved.saturating_sub(2 * code as usize)..=moved).contains(&bad),
            "{line}"
        );
    }
    // On one line they leave a turn about it free; rounding does not help.
    for bent in [0.0, 1e-6, 0.5] {
        let mut lined = points.clone();
        for (k, point) in (0..12).zip(&mut lined) {
            let along = f64::from(k);
            *point = [
                along,
                2.0 * along,
                5.0 + along / 3.0 + f64::from(k % 3) * bent,
            ];
        }
        write(&at.join("one"), HERE, &seeing(0..3), &lined);
        write(&at.join("other"), THERE, &seeing(3..6), &lined);
        let found = merge(at, &[database, "--min-inliers", "10", "--json"]);
        let line = keeps_to("merge", &found, &["misfit"]).remove(0);
        let is_free = bent < 0.1;
        assert_eq!(
            (found.code, &line["freedom"]),
            (i32::from(is_free), &u32::from(is_free).into()),
            "{line}"
        );
        let free = match is_free {
            true => "a turn about the line through the points of both",
            false => "nothing",
        };
        assert_eq!(line["free"], free);
        let condition = Some("if every pair is right").filter(|_| !is_free);
        assert_eq!(
            line.get("condition"),
            condition.map(serde_json::Value::from).as_ref()
        );
    }
    // Of fewer points two leave a turn, one every turn and the scale.
    write(&at.join("one"), HERE, &seeing(0..3), &points);
    for (shared, freedom) in [(0, 7), (1, 4), (2, 1), (3, 0)] {
        let mut images = seeing(3..6);
        let is_kept = |k: &usize| *k < shared || *k >= 12;
        for image in &mut images {
            image.seen = (0..points.len()).map(|k| Some(k).filter(is_kept)).collect();
        }
        write(&at.join("other"), THERE, &images, &points);
        let found = merge(at, &[database, "--min-inliers", "10", "--json"]);
        let line = keeps_to("merge", &found, &["freedom", "shared_points"]).remove(0);
        assert_eq!(
            (&line["shared_points"], &line["freedom"]),
            (&shared.into(), &freedom.into()),
            "{line}"
        );
    }
    let found = merge(at, &[database, "--min-views", "2"]);
    assert_eq!(found.code, 2, "{}", found.out);
    assert!(found.err.contains("none are counted here"), "{}", found.err);
    let text = at.join("one/cameras.txt");
    let found = merge(at, &[text.to_str().unwrap()]);
    assert_eq!(found.code, 2, "{}", found.out);
    assert!(found.err.contains("no database of COLMAP"), "{}", found.err);
    write(&at.join("one"), HERE, &seeing(0..3), &points);
    // A model of another database, where images have other features.
    let mut images = seeing(3..6);
    images[0].seen.push(None);
    write(&at.join("other"), THERE, &images, &points);
    let found = merge(at, &[database]);
    assert_eq!(found.code, 2, "{}", found.out);
    let why = "image 03.jpg has 21 features in a model and 20 in the database";
    assert!(found.err.contains(why), "{}", found.err);
}

#[test]
fn images_at_one_centre_leave_the_scale_free() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let turntable = |images: std::ops::Range<u32>| {
        let mut images = walk(images);
        for image in images
            .iter_mut()
            .filter(|image| (3..6).contains(&(image.id - 1)))
        {
            image.centre = [4.0, 4.0, 4.0];
        }
        images
    };
    write(&at.join("one"), HERE, &turntable(0..6), &[]);
    write(&at.join("other"), THERE, &turntable(3..9), &[]);
    let found = merge(at, &["--json"]);
    let line = &found.json()[0];
    assert_eq!(
        (found.code, &line["shared_places"]),
        (1, &1.into()),
        "{line}"
    );
    assert_eq!(
        (&line["determined"], &line["freedom"]),
        (&false.into(), &1.into())
    );
    assert_eq!(line["misfit"]["agree"], true);
    assert_eq!(line["free"], "relative scale");
    // Where only one of the two has them there, both cannot be right.
    write(&at.join("other"), THERE, &walk(3..9), &[]);
    let line = &merge(at, &["--json"]).json()[0];
    assert_eq!(line["misfit"]["agree"], false, "{line}");
}

#[test]
fn poses_that_are_none_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    write(&at.join("one"), HERE, &walk(0..4), &[]);
    for bad in ["3 nan 0 0 0", "3 1 0 inf 0", "3 0 0 0 0"] {
        write(&at.join("other"), HERE, &walk(0..4), &[]);
        let path = at.join("other/images.txt");
        let text = fs::read_to_string(&path)
            .unwrap()
            .replace("\n3 1 0 0 0", &format!("\n{bad}"));
        assert!(text.contains(bad), "{text}");
        fs::write(&path, text).unwrap();
        let found = merge(at, &[]);
        assert_eq!(found.code, 2, "{}", found.out);
        let said = found.err.replace('\\', "/");
        assert!(
            said.contains("other/images.txt: the pose of image 02.jpg"),
            "{said}"
        );
    }
}

/// Where images of both have other features, the models are of different databases: their points are not compared.
#[test]
#[ignore = "needs data"]
fn points_of_other_databases_are_not_compared() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let points = [[0.0, 0.0, 5.0], [1.0, 0.0, 6.0], [0.0, 2.0, 5.0]];
    let seeing = |features: usize, first: u32| {
        let mut images = walk(0..5);
        for image in &mut images {
            image.id += first;
            image.seen = (0..features).map(|k| Some(k).filter(|&k| k < 3)).collect();
        }
        images
    };
    write(&at.join("one"), HERE, &seeing(3, 0), &points);
    for (features, first, shared) in [(3, 0, 3), (3, 100, 3), (4, 0, 0)] {
        write(&at.join("other"), THERE, &seeing(features, first), &points);
        let found = merge(at, &["--json"]);
        assert_eq!(found.code, 0, "{}{}", found.out, found.err);
        let line = &found.json()[0];
        assert_eq!(line["shared_points"], shared);
        assert_eq!(line["misfit"]["points"], shared);
    }
    let data = data().join("turn4/files");
    let [one, other] = ["merge_a", "merge_other_db"].map(|name| data.join(name));
    let found = verify(&["merge", one.to_str().unwrap(), other.to_str().unwrap()]);
    assert!(found.out.contains(" places, 0 points\n"), "{}", found.out);
}
