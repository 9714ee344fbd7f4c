#!/usr/bin/env python3
"""Tests of contradictions.py: each condition of docs/contradictions.md is broken once, and mutants."""

import contextlib
import copy
import io
import json
import os
import random
import shutil
import sqlite3
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "tests")]

import check  # noqa: E402
import contradict  # noqa: E402
from notation import Reject, Unreadable  # noqa: E402

FOLDER = os.path.join(HERE, "..", "tests", "contradictions")


def read(name):
    with open(os.path.join(FOLDER, name), encoding="utf-8") as file:
        return json.load(file)


class Contradictions(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.path = os.path.join(cls.folder, "made.db")
        contradict.write_database(cls.path, read("rows.json"))

    def setUp(self):
        self.document = read("certificate.json")

    def changed(self, *statements):
        """Another database, by SQL, and the document with its hash."""
        path = os.path.join(self.folder, "changed.db")
        shutil.copyfile(self.path, path)
        connection = sqlite3.connect(path)
        for statement in statements:
            connection.execute(statement)
        connection.commit()
        connection.close()
        self.document["database"] = contradict.Source(path).check.hash_of_database()
        return path

    def rejected(self, reason, path=None):
        with self.assertRaisesRegex(Reject, reason):
            check.check(self.document, database=path)

    def test_what_is_right(self):
        said = check.check(self.document).statements()
        self.assertIn("at least 1 of 10 pairs are off by more than 10 degrees (proof), about the numbers written here", said[1])
        self.assertIn("their directions by more than 20, if 4 others are right within 8 degrees (proof)", said[3])
        self.assertIn("of this database", check.check(self.document, database=self.path).statements()[1])
        with self.assertRaisesRegex(Reject, "about motions"):
            check.check(self.document, model="calibrated")

    def test_what_is_generated_is_what_is_kept(self):
        self.assertEqual(list(contradict.made()), [read("rows.json"), self.document])

    def test_the_numbers(self):
        def walk(at, value):
            return lambda d: d["packings"][0]["cycles"][0].update(walk=value)

        first = self.document["packings"][0]["cycles"][0]["walk"]
        cases = [
            ("version is not 3", lambda d: d.update(version=4)),
            ("not read any more", lambda d: d.update(format="viewcert certificate of contradictions", version=1)),
            ("program", lambda d: d.update(program=1)),
            ("64 digits", lambda d: d.update(database="0" * 63)),
            ("two of one name", lambda d: d.update(images=d["images"][:-1] + d["images"][:1])),
            ("not two ends", lambda d: d["pairs"][0].update(ends=[0])),
            ("one image", lambda d: d["pairs"][0].update(ends=[0, 0])),
            ("out of range", lambda d: d["pairs"][0].update(ends=[0, 7])),
            ("another configuration", lambda d: d["pairs"][0].update(configuration=4)),
            ("has not 4 entries", lambda d: d["pairs"][0].update(q=[1, 0, 0])),
            ("is zero", lambda d: d["pairs"][0].update(t=[0, 0, 0])),
            ("there twice", lambda d: d["excluded"].append(dict(d["pairs"][0], ends=[1, 0]))),
            ("no database", lambda d: (d.update(database=None), [p.update(configuration=None) for p in d["pairs"] + d["excluded"]])),
            ("is 90|out of range", lambda d: d["packings"][0].update(theta=90)),
            ("below 10", lambda d: d["packings"][0].update(phi=9)),
            ("phi without", lambda d: d["packings"][0].update(phi=20)),
            ("witness without phi", lambda d: d["packings"][2].update(phi=None)),
            ("not increasing", lambda d: d["packings"][2].update(assumed=[4, 0, 7, 9])),
            ("out of range", lambda d: d["packings"][2].update(assumed=[0, 10])),
            ("below 1", lambda d: d["packings"][0].update(denominator=0)),
            ("out of range|below", lambda d: d["packings"][2].update(assumed_within=0)),
            ("out of range|below", lambda d: d["packings"][2].update(assumed_within=8001)),
            ("C6", lambda d: d["packings"][3].update(assumed_within=7000)),
            ("sum to 180", lambda d: d["packings"][0].update(theta=60)),
            ("below 0", lambda d: d["packings"][0]["cycles"][0].update(weight=-1)),
            ("no list of two", walk(0, [[1]] + first[1:])),
            ("no sense", walk(0, [[1, 2]] + first[1:])),
            ("too short", walk(0, first[:1])),
            ("taken twice", walk(0, first + first)),
            ("not closed", walk(0, first[:2])),
            ("C5", lambda d: d["packings"][0].update(assumed=sorted(k for k, _ in first))),
            ("C6", lambda d: d["packings"][0].update(theta=40)),
            ("no t", lambda d: d["pairs"][9].update(t=None)),
            ("90 or more", lambda d: d["packings"][2].update(theta=45, phi=50, cycles=d["packings"][2]["cycles"][1:])),
            ("too far", lambda d: d["packings"][2]["cycles"][1].update(witness=[1, 0, 9])),
            ("too far", lambda d: d["packings"][2]["cycles"][1].update(witness=[-x for x in d["packings"][2]["cycles"][1]["witness"]])),
            ("more than one", lambda d: d["packings"][0]["cycles"][0].update(weight=2)),
            ("C8. at_least", lambda d: d["packings"][0].update(at_least=2)),
            ("not a rotation for each", lambda d: d["upper"][0]["rotations"].pop()),
            ("C9", lambda d: d["upper"][0].update(at_most=3)),
        ]
        right = copy.deepcopy(self.document)
        for reason, change in cases:
            with self.subTest(reason=reason):
                self.document = copy.deepcopy(right)
                change(self.document)
                self.rejected(reason)

    def test_the_binding(self):
        pairs = self.document["pairs"]
        by_qvec, by_e = pairs[3], pairs[0]
        vector = by_e["t"]
        cases = [
            ("B1", lambda d: d.update(database="0" * 64)),
            ("no image", lambda d: d["images"].__setitem__(0, "0.jpg")),
            ("is no row", lambda d: d["pairs"].append({"ends": [5, 6], "configuration": 2, "q": [1, 0, 0, 0], "t": None})),
            ("cannot be checked", lambda d: d["pairs"].append({"ends": [0, 6], "configuration": 2, "q": [1, 0, 0, 0], "t": None})),
            ("not listed", lambda d: d["excluded"].clear()),
            ("configuration", lambda d: d["pairs"][0].update(configuration=3)),
            ("B5. a pair by qvec", lambda d: d["excluded"].append(d["pairs"].pop(3))),
            ("B5. q", lambda d: d["pairs"][3].update(q=[by_qvec["q"][0] + 2**16, *by_qvec["q"][1:]])),
            ("B5. t", lambda d: d["pairs"][3].update(t=[-x for x in by_qvec["t"]])),
            ("B5. t", lambda d: d["pairs"][6].update(t=[1, 0, 0])),
            ("without t", lambda d: d["pairs"][0].update(t=None)),
            ("B3", lambda d: d["pairs"][0].update(t=[vector[0], vector[1] + 2**12, vector[2]])),
            ("B4", lambda d: d["pairs"][0].update(t=[-x for x in vector])),
            ("B4", lambda d: d["pairs"].append(d["excluded"].pop())),
            ("B6", lambda d: d["excluded"].append(d["pairs"].pop(0))),
        ]
        # What the packings say is right with other numbers too.
        self.document.update(packings=[], upper=[])
        right = copy.deepcopy(self.document)
        for reason, change in cases:
            with self.subTest(reason=reason):
                self.document = copy.deepcopy(right)
                change(self.document)
                check.check(self.document)
                self.rejected(reason, self.path)

    def test_databases(self):
        first = 1 * 2147483647 + 2
        # Each makes the pair of the first two images uncheckable.
        for change in (
            f"update two_view_geometries set rows = 15 where pair_id = {first}",
            f"update two_view_geometries set E = zeroblob(72), qvec = null where pair_id = {first}",
            f"update two_view_geometries set E = cast(substr(E, 1, 64) || x'0000000000000840' as blob), qvec = x'00' where pair_id = {first}",
            "update keypoints set cols = 1 where image_id = 1",
            "update keypoints set rows = 4, data = substr(data, 1, 32) where image_id = 1",
            "update keypoints set data = cast(x'0000c07f' || substr(data, 5) as blob) where image_id = 1",
            "update cameras set params = substr(params, 1, 24) where camera_id = 1",
            "update cameras set params = cast(x'0000000000000000' || substr(params, 9) as blob) where camera_id = 1",
            "update cameras set model = 5 where camera_id = 1",
            "update cameras set prior_focal_length = 0 where camera_id = 1",
            "delete from cameras where camera_id = 1",
            "delete from keypoints where image_id = 1",
            "drop table keypoints",
        ):
            with self.subTest(change=change):
                path = self.changed("update two_view_geometries set qvec = null", change)
                self.assertNotIn([0, 1], [pair["ends"] for pair in contradict.Source(path).pairs])
                self.rejected("cannot be checked", path)
        # The measurement is E as long as there is one, and qvec in configuration 2 otherwise.
        path = self.changed("update two_view_geometries set E = null where config = 2")
        found = contradict.Source(path)
        self.assertEqual([pair["ends"] for pair in found.pairs][:3], [[0, 1], [0, 2], [0, 3]])
        check.check(found.document([], []), database=path)
        for change in ("update images set name = '1.jpg'", "update cameras set model = 'x'", "insert into cameras select * from cameras", "drop table images"):
            with self.subTest(change=change), self.assertRaises(Unreadable):
                self.changed(change)
        for path in (__file__, os.path.join(self.folder, "absent.db")):
            with self.assertRaises(Unreadable):
                check.check(self.document, database=path)

    def test_program(self):
        path = os.path.join(self.folder, "certificate.json")
        with open(path, "w", encoding="utf-8") as file:
            json.dump(self.document, file)
        for files, code, said in (([path], 0, "written here"), ([path, self.path], 0, "of this database"), ([path, path], 2, "not a database")):
            out = io.StringIO()
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
                self.assertEqual(check.main(files), code)
            self.assertIn(said, out.getvalue())

    def test_mutants(self):
        """No mutant is about other numbers than the database's."""
        mutants = contradict.Mutants(self.document, random.Random(1))
        accepted = 0
        for _ in range(300):
            mutant = mutants.next()
            try:
                check.check(mutant)
                accepted += 1
                self.assertTrue(contradict.true(mutant))
                check.check(mutant, database=self.path)
            except Reject:
                continue
            self.assertTrue(contradict.same_motions(mutant, self.document))
        self.assertGreater(accepted, 20)


if __name__ == "__main__":
    unittest.main()
