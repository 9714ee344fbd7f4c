use crate::{NamedGraph, ReadOptions, read_cameras, read_graphs};
use std::path::Path;
use std::process::Command;
use viewcert::Model;

/// Three cameras at (-1, -2, -3), (-4, -5, -6), (-7, -8, -10): [I | t] with numbers that tell all places apart, written by NumPy and SciPy.
const WRITE: &str = "
import sys, numpy as np, scipy.io as io
t = np.array([[1, 2, 3], [4, 5, 6], [7, 8, 10.0]])
p = np.concatenate([np.tile(np.eye(3), (3, 1, 1)), t[:, :, None]], axis=2)
d = sys.argv[1] + '/'
np.savez(d + 'numbers.npz', p=p, more=np.zeros(3))
np.savez_compressed(d + 'names.npz', p=np.concatenate([p[1:2], p[1:2] * 2, p[2:], p[:1]]), names=np.array(['b', 'z', 'c', 'a']))
np.savez(d + 'twice.npz', p=p[[0, 1, 2, 0]], names=np.array(['a', 'b', 'c', 'a']))
np.savez(d + 'two.npz', p=p, q=p)
np.savez(d + 'none.npz', p=t.T[:2])
np.save(d + 'centres.npy', -t)
io.savemat(d + 'cameras.mat', {'P': np.moveaxis(p, 0, 2), 'n': 3})
io.savemat(d + 'centres.mat', {'C': -t}, do_compression=True)
io.savemat(d + 'two.mat', {'C': -t, 'D': t})
io.savemat(d + 'none.mat', {'C': t[:2]})
import h5py
def hdf5(name, **arrays):
    with h5py.File(d + name, 'w', userblock_size=512) as file:
        for key, value in arrays.items():
            # MATLAB's first index changes fastest, HDF5's last one.
            file.create_dataset(key, data=value.T).attrs['MATLAB_class'] = np.bytes_(value.dtype.name.replace('float64', 'double'))
    with open(d + name, 'r+b') as file:
        file.write(b'MATLAB 7.3 MAT-file, Platform: GLNXA64'.ljust(124) + b'\\0\\2IM')
hdf5('cameras73.mat', P=np.moveaxis(p, 0, 2), n=np.zeros((1, 1)))
hdf5('centres73.mat', C=-t)
hdf5('integers73.mat', C=-t.astype(np.int64))
hdf5('long73.mat', C=np.full((3, 3), 2**53 + 1))
";

fn graph(folder: &Path, text: &str) -> NamedGraph {
    let path = folder.join("pairs");
    std::fs::write(&path, text).unwrap();
    read_graphs(&path, &ReadOptions::default())
        .next()
        .unwrap()
        .unwrap()
}

fn written() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let python = std::env::var("VIEWCERT_PYTHON").unwrap_or("python3".into());
    let run = Command::new(python)
        .args(["-c", WRITE])
        .arg(folder.path())
        .output()
        .unwrap();
    assert!(
        run.status.success(),
        "{}",
        String::from_utf8_lossy(&run.stderr)
    );
    folder
}

/// The hash of the centres, or the message.
fn read(folder: &Path, name: &str, graph: &NamedGraph) -> Result<[u8; 32], String> {
    let read = read_cameras(&folder.join(name), graph, Model::Calibrated);
    let read = read.map_err(|error| error.to_string())?;
    Ok(read.expect("a file of cameras").centres.sha256())
}

#[test]
fn arrays_tables_and_lines_say_the_same() {
    let folder = written();
    let folder = folder.path();
    let [numbers, names] = ["0 1\n1 2\n", "a b\nb c\n"].map(|text| graph(folder, text));
    let lines = "0 -1 -2 -3\n1 -4 -5 -6\n2 -7 -8 -10\n".replace('\n', "\ncentre ");
    let lines = format!("centre {}", lines.strip_suffix("centre ").unwrap());
    std::fs::write(folder.join("lines.txt"), lines).unwrap();
    let table = "# by hand\nimage,tz,qw,qx,qy,qz,tx,ty\nb,6,1,0,0,0,4,5\na,3,-2,0,0,0,1,2\nc,10,.5,0,0,0,7,8\n";
    std::fs::write(folder.join("poses.csv"), table).unwrap();
    let table = "Name,p00,p01,p02,p03,p10,p11,p12,p13,p20,p21,p22,p23\na,1,0,0,1,0,1,0,2,0,0,1,3\n\
                 b,1,0,0,4,0,1,0,5,0,0,1,6\nc,1,0,0,7,0,1,0,8,0,0,1,10\n";
    std::fs::write(folder.join("matrices.csv"), table).unwrap();
    std::fs::write(
        folder.join("centres.tsv"),
        "camera\ty\tx\tz\na\t-2\t-1\t-3\nb\t-5\t-4\t-6\nc\t-8\t-7\t-10\n",
    )
    .unwrap();
    let expected = read(folder, "lines.txt", &numbers).unwrap();
    for name in ["numbers.npz", "centres.npy", "cameras.mat", "centres.mat"] {
        assert_eq!(read(folder, name, &numbers), Ok(expected), "{name}");
    }
    for name in ["names.npz", "poses.csv", "matrices.csv", "centres.tsv"] {
        assert_eq!(read(folder, name, &names), Ok(expected), "{name}");
    }
}

/// By programs with HDF5; the others say what to do.
#[test]
fn matlab_7_3() {
    let folder = written();
    let folder = folder.path();
    let numbers = graph(folder, "0 1\n1 2\n");
    let expected = read(folder, "centres.npy", &numbers);
    for name in ["cameras73.mat", "centres73.mat", "integers73.mat"] {
        let found = read(folder, name, &numbers);
        if cfg!(feature = "hdf5") {
            assert_eq!(found, expected, "{name}");
        } else {
            let error = found.unwrap_err();
            assert!(error.contains("build it with it"), "{error}");
        }
    }
    let error = read(folder, "long73.mat", &numbers).unwrap_err();
    if cfg!(feature = "hdf5") {
        assert!(error.contains("an integer of 2^53 or beyond"), "{error}");
    }
}

#[test]
fn what_is_refused() {
    let folder = written();
    let folder = folder.path();
    let [numbers, names] = ["0 1\n1 2\n", "a b\nb c\n"].map(|text| graph(folder, text));
    for (name, expected) in [
        ("two.npz", "several arrays may be the cameras: p, q"),
        ("two.mat", "several arrays may be the cameras: C, D"),
        ("none.npz", "an array of shape [2, 3] holds neither cameras"),
        (
            "none.mat",
            "no array holds cameras (3 x 4 x n) or centres (n, 3) of the 3 nodes",
        ),
    ] {
        let error = read(folder, name, &numbers).unwrap_err();
        assert!(error.contains(expected), "{name}: {error}");
    }
    let error = read(folder, "twice.npz", &names).unwrap_err();
    assert!(
        error.contains("the camera of `a` is given twice"),
        "{error}"
    );
    let error = read(folder, "cameras.mat", &names).unwrap_err();
    assert!(error.contains("nodes with names take"), "{error}");
    std::fs::write(folder.join("short.csv"), "name,x,y,z\na,1,2,3\nb,1,2\n").unwrap();
    let error = read(folder, "short.csv", &names).unwrap_err();
    assert!(
        error.contains("short.csv:3: 2 numbers stand behind the camera, and 3"),
        "{error}"
    );
    std::fs::write(folder.join("other.csv"), "name,x,y,w\na,1,2,3\n").unwrap();
    assert!(
        read_cameras(&folder.join("other.csv"), &names, Model::Calibrated)
            .unwrap()
            .is_none()
    );
    let bytes = std::fs::read(folder.join("cameras.mat")).unwrap();
    std::fs::write(folder.join("cut.mat"), &bytes[..bytes.len() - 40]).unwrap();
    assert!(read(folder, "cut.mat", &numbers).is_err());
}
