"""The documentation's site is made, whole, and every link in it leads somewhere. usage: test_site.py OUTDIR

Without mkdocs and its theme the status is 77.
"""
import glob
import html.parser
import json
import os
import re
import shutil
import subprocess
import sys
import unittest
from urllib.parse import unquote, urldefrag

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
OUTDIR = sys.argv[1]
SITE = os.path.join(OUTDIR, "html")
REPOSITORY = "https://github.com/SurgicalMesher/SurgicalMesher"
SKIPPED = 77


class Page(html.parser.HTMLParser):
    """What a page links to and loads, and the places in it that links can name."""

    def __init__(self, name):
        super().__init__()
        self.links, self.loaded, self.places = [], [], {""}
        with open(os.path.join(SITE, name), encoding="utf-8") as file:
            self.feed(file.read())

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        self.places |= {attributes[key] for key in ("id", "name") if attributes.get(key)}
        if tag == "a" and attributes.get("href"):
            self.links.append(attributes["href"])
        if tag in ("img", "script") and attributes.get("src"):
            self.loaded.append(attributes["src"])
        if tag == "link" and attributes.get("rel") == "stylesheet":
            self.loaded.append(attributes["href"])


class SiteTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(OUTDIR, ignore_errors=True)
        done = subprocess.run([os.path.join(ROOT, "Docs", "build.sh"), OUTDIR], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
        assert done.returncode == 0, done.stdout
        names = [name for name in os.listdir(SITE) if name.endswith(".html") and name != "404.html"]
        cls.pages = {name: Page(name) for name in names}

    def test_every_page_is_there_and_in_the_contents(self):
        expected = {name.replace(".md", ".html") for name in os.listdir(os.path.join(ROOT, "Docs")) if name.endswith(".md")}
        self.assertEqual(set(self.pages), expected | {"index.html", "CONTRIBUTING.html", "CHANGELOG.html", "Options.html"})
        linked = {urldefrag(link)[0] for link in self.pages["index.html"].links}
        self.assertLessEqual(set(self.pages) - {"index.html"}, linked)

    def test_every_option_is_on_the_generated_page(self):
        with open(os.path.join(SITE, "Options.html"), encoding="utf-8") as file:
            page = file.read()
        descriptions = glob.glob(os.path.join(ROOT, "*", "CLI", "*.xml")) + glob.glob(os.path.join(ROOT, "Program", "*.xml"))
        self.assertEqual(page.count("<h2"), len(descriptions))
        for file in descriptions:
            with open(file, encoding="utf-8") as description:
                for flag in re.findall("<longflag>(.*)</longflag>", description.read()):
                    self.assertIn(f"<code>--{flag}</code>", page, file)

    def test_links_lead_somewhere(self):
        for name, page in self.pages.items():
            for link in page.links:
                target, place = urldefrag(link)
                if target.startswith(REPOSITORY):
                    path = target[len(REPOSITORY):].partition("/blob/main/")[2]
                    self.assertTrue(os.path.exists(os.path.join(ROOT, path)), f"{link} in {name}")
                elif "://" not in target and not target.startswith("mailto:"):
                    target = os.path.normpath(target or name)
                    target = "index.html" if target == "." else target
                    self.assertIn(target, self.pages, f"{link} in {name}")
                    self.assertIn(unquote(place), self.pages[target].places, f"{link} in {name}")

    def test_nothing_is_loaded_from_elsewhere(self):
        for name, page in self.pages.items():
            for file in page.loaded:
                self.assertTrue(os.path.exists(os.path.join(SITE, file)), f"{file} in {name}")

    def test_it_can_be_searched(self):
        with open(os.path.join(SITE, "search", "search_index.json"), encoding="utf-8") as file:
            entries = json.load(file)["docs"]
        found = {entry["location"].partition("#")[0] for entry in entries if "nullDisplacementRadius" in entry["text"]}
        self.assertLessEqual({"SurgicalPathScale.html", "FuchsTetrahedralizer.html"}, found)


if __name__ == "__main__":
    try:
        import mkdocs.theme

        mkdocs.theme.Theme("material")
    except (ImportError, KeyError):
        print("not installed: mkdocs, mkdocs-material")
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1])
