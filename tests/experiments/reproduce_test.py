"""What reproduce.py does with claims that hold, do not hold, or cannot be run."""

import contextlib
import io
import pathlib
import re
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "experiments/paper"))

import reproduce  # noqa: E402
import run_tables  # noqa: E402


def not_holding(_):
    run_tables.hold(False, "3 is not 4")


HOLDS = ("holds", "theirs", ("printf 7",), lambda printed: (printed, "reproduced"))
FAILS = ("fails", "theirs", ("printf 7",), not_holding)
MISSING = ("missing", "theirs", ("no_such_study 5",), not_holding)
STATUS_3 = ("status 3", "theirs", ("sh -c 'echo why >&2; exit 3'",), lambda _: ("", "reproduced"))
TEXT = f"before\n{reproduce.BEGIN}\nstale\n{reproduce.END}\nafter\n"


class Reproduce(unittest.TestCase):
    def run_claims(self, *claims):
        """Exit status and the page afterwards."""
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "reproduction.md"
            page.write_text(TEXT)
            with contextlib.redirect_stderr(io.StringIO()):
                status = reproduce.main(list(claims), page)
            self.assertEqual([page], list(pathlib.Path(folder).iterdir()))
            return status, page.read_text()

    def test_rewrites_only_what_is_between_the_markers(self):
        status, text = self.run_claims(HOLDS)
        self.assertEqual(0, status)
        self.assertRegex(text, r"\| holds \| `printf 7` \| \d+\.\d \| theirs \| 7 \| reproduced \|")
        self.assertNotIn("stale", text)
        self.assertTrue(text.startswith(f"before\n{reproduce.BEGIN}\n"))
        self.assertTrue(text.endswith(f"{reproduce.END}\nafter\n"))

    def test_a_claim_that_does_not_hold_is_status_1_and_a_row(self):
        status, text = self.run_claims(HOLDS, FAILS)
        self.assertEqual(1, status)
        self.assertIn("**does not hold**: 3 is not 4", text)

    def test_a_command_that_fails_does_not_hold(self):
        status, text = self.run_claims(STATUS_3)
        self.assertEqual(1, status)
        self.assertIn("why", text)

    def test_a_program_that_is_not_built_is_told_and_no_failure(self):
        status, text = self.run_claims(MISSING, HOLDS)
        self.assertEqual(0, status)
        self.assertIn("not run: no_such_study is not built", text)

    def test_the_readme_counts_the_rows_of_the_page(self):
        page = (run_tables.ROOT / "notebooks-data/reproduction.md").read_text()
        table = page[page.index(reproduce.BEGIN):page.index(reproduce.END)]
        found = [re.split(r"[:(]", row.split("|")[6])[0].strip()
                 for row in table.splitlines() if row.startswith("| ")][1:]
        told = dict((word, int(count)) for count, word in re.findall(
            r"(\d+) (reproduced|better|out of scope|differ)",
            (run_tables.ROOT / "README.md").read_text()))
        self.assertEqual({"reproduced": found.count("reproduced"), "better": found.count("better"),
                          "differ": found.count("differs"),
                          "out of scope": found.count("out of scope")}, told)
        self.assertEqual(len(found), sum(told.values()))


if __name__ == "__main__":
    unittest.main()
