#!/usr/bin/env python3
"""The manual in a browser: the search works, messages find the family that tools/manual gives, all pages fit.
Skipped where there is no chromium."""
import html
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tools/python"), str(ROOT)]
from tests.support import sus  # noqa: E402

BROWSER = shutil.which("chromium") or shutil.which("google-chrome")
SAMPLE = ("index.html", "gallery/index.html", "gallery/solid-two_discs.html", "reference/index.html",
          "reference/shared-MPM.html", "reference/uintah.html", "messages.html", "api/tasks.html", "methods/core.html",
          "tutorials/own_material.html")
MESSAGES = ("a.ups:3:4: Time: unknown tag <maxTimes> in <Time> (did you mean 'maxTime'?)",
            "found 'abc', expected a number",
            "sus: p.density became -1 kg/m^3 (was 1), but must be greater than 0: particle 3", "nonsense")
MEASURE = """<!doctype html><body><pre id="out"></pre><script>
const urls = %s, frame = document.createElement("iframe"), out = document.getElementById("out");
let at = 0;
frame.style.cssText = "border:0;height:900px;width:%dpx";
frame.onload = () => {
  out.textContent += frame.contentDocument.documentElement.scrollWidth + " ";
  if (++at < urls.length) frame.src = urls[at];
};
frame.src = urls[0];
document.body.append(frame);
</script>"""
ASK = """<!doctype html><body data-root=""><input id="search"><ol id="results"></ol><pre id="out"></pre>
<script src="search-index.js"></script><script src="site.js"></script><script>
document.getElementById("out").textContent = JSON.stringify([%s.map(text => (familyOf(text) || [null])[0]),
  %s.map(text => (find(text)[0] || [0, null])[1])]);
</script>"""


@unittest.skipUnless(BROWSER, "there is no chromium")
class Browser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        try:
            from tushar.manual.pictures import Album
            from tushar.manual.site import Site
        except ImportError:
            raise unittest.SkipTest("python3-markdown-it is missing") from None
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.site = pathlib.Path(cls.folder.name, "site")
        Site(sus.SUS, Album(sus.SUS, False, f"{cls.folder.name}/cache")).write(cls.site)

    def shown(self, text):
        """Returns what a page writes into #out."""
        page = self.site / "check.html"
        page.write_text(text)
        command = [BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--allow-file-access-from-files",
                   f"--user-data-dir={self.folder.name}/profile", "--window-size=1500,1000",
                   "--virtual-time-budget=60000", "--dump-dom", page.as_uri()]
        dom = subprocess.run(command, capture_output=True, text=True, timeout=120).stdout
        page.unlink()
        return html.unescape(dom.partition('<pre id="out">')[2].partition("</pre>")[0])

    def test_no_page_is_wider_than_a_telephone_or_a_screen(self):
        self.assertEqual([page for page in SAMPLE if not (self.site / page).exists()], [])
        for width in (400, 1300):
            widths = self.shown(MEASURE % (json.dumps(SAMPLE), width)).split()
            wide = [f"{url}: {found}" for url, found in zip(SAMPLE, widths) if int(found) > width]
            self.assertEqual(len(widths), len(SAMPLE))
            self.assertEqual(wide, [], width)

    def test_the_search_and_the_field_for_messages(self):
        from tushar.manual.messages import family_of
        words = ["maxTime", "TaskList perPatch", "zzzz"]
        families, first = json.loads(self.shown(ASK % (json.dumps(MESSAGES), json.dumps(words))))
        expected = [family.id if (family := family_of(text)) else None for text in MESSAGES]
        self.assertEqual(families, expected)
        self.assertEqual(expected, ["T101", "T105", "T301", None])
        self.assertEqual(first, ["<maxTime>", "TaskList::perPatch", None])


if __name__ == "__main__":
    unittest.main()
