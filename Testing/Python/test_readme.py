"""The documentation agrees with the project: commands, options and their defaults, links, languages."""
import glob
import os
import re
import subprocess
import unittest
import xml.etree.ElementTree as xml

import matplotlib.pyplot as plt

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
MODULES = ("SurgicalPathScale", "SimplexMesher", "FuchsTetrahedralizer")
# Programs without a panel of their own: their folder, whose name their page has, too.
PROGRAMS = {"BalloonSurface": "SimplexMesher",
            "LocalRegistration": "TissueMapper",
            "MultirateSolver": "MultirateSolver",
            "SurfaceRemesher": "SimplexMesher",
            "TemplateFit": "TemplateHexMesher",
            "TissueMapper": "TissueMapper",
            "TubePath": "TissueMapper",
            "VolumetricHex": "TemplateHexMesher"}
PAGES = (["README.md", "CONTRIBUTING.md", "CHANGELOG.md"] + [f"Docs/{module}.md" for module in MODULES]
         + ["Docs/TemplateHexMesher.md", "Docs/TissueMapper.md", "Docs/Cohort.md", "Docs/Benchmarks.md", "Docs/MultirateSolver.md", "Docs/Fitness.md", "Docs/Evidence.md",
            "Docs/Solvers.md", "Docs/Slicer.md", "Docs/Tutorial.md", "Docs/ImageTutorial.md", "Docs/HeadPhantom.md", "Docs/surgicalmesher.md", "Docs/Packages.md", "Docs/Python.md", "Docs/Systems.md"])


def text_of(*path):
    with open(os.path.join(ROOT, *path), encoding="utf-8") as file:
        return file.read()


def readme_commands():
    blocks = re.findall(r"^```(\w*)\n(.*?)^```", text_of("README.md"), re.M | re.S)
    lines = [line.strip() for language, block in blocks if language == "sh" for line in block.splitlines()]
    return [line for line in lines if line]


def example_commands():
    """What example.sh runs of the three modules, each on one line."""
    script = re.sub(r"\\\n\s*", "", text_of("example.sh"))
    return [line for line in re.findall(r"^stage \w+ (.*)$", script, re.M) if line.split()[0].endswith("CLI")]


def options_of(module):
    """Long flag -> default, and the names of the positional arguments, as the module's description has them."""
    flags, positional = {}, {}
    description = text_of(PROGRAMS.get(module, module), "CLI", module + "CLI.xml")
    for parameter in xml.fromstring(description).iterfind("parameters/*"):
        if parameter.find("longflag") is not None:
            flags[parameter.findtext("longflag")] = parameter.findtext("default") or ""
        elif parameter.find("index") is not None:
            positional[int(parameter.findtext("index"))] = parameter.findtext("name")
    return flags, [positional[index] for index in sorted(positional)]


def section_of(module):
    """What a page says of one program: from its usage on, up to that of the next."""
    page = text_of("Docs", PROGRAMS.get(module, module) + ".md")
    parts = re.split(r"^(?=    \w+CLI \[options\])", page, flags=re.M)
    return next(part for part in parts if part.startswith(f"    {module}CLI "))


def anchors_of(page):
    headings = re.findall(r"^#+ (.*)$", text_of(page), re.M)
    return [re.sub(r"[^\w -]", "", heading).lower().replace(" ", "-") for heading in headings]


class ReadmeTest(unittest.TestCase):
    def test_every_fenced_block_is_tested(self):
        languages = re.findall(r"^```(\w*)\n.*?^```", text_of("README.md"), re.M | re.S)
        self.assertEqual(set(languages), {"sh"}, "a block in another language would go unchecked")

    def test_commands_are_those_of_the_example(self):
        commands = readme_commands()
        scripts = [command for command in commands if command.startswith("./")]
        self.assertEqual(scripts, ["./example.sh", "./test.sh"])
        self.assertEqual([command for command in commands if command not in scripts], example_commands())

    def test_commands_can_be_pasted(self):
        for page in PAGES:
            lines = text_of(page).split("\n")
            for before, line in zip(lines, lines[1:]):
                if re.match(r" {5,}--\w", line):  # a command goes on
                    self.assertTrue(before.endswith(" \\"), f"{page}: {line}")
        text = text_of("README.md") + text_of("Docs/Solvers.md")
        for command in re.findall(r"^    (?:\./|\w+CLI |run_).*$", text, re.M):
            self.assertNotIn("...", command)

    def test_first_words_say_which_map_and_which_algorithms(self):
        introduction = text_of("README.md").split("\n## ")[0]
        for word in ("*prepared map*", "Maubach", "guarded", "--ambient"):
            self.assertIn(word, introduction)
        self.assertNotIn("topology that it has in the map", " ".join(introduction.split()))

    def test_what_the_trial_missed_is_told(self):
        """2.4 to 2.11 of the trial, in its order."""
        for page, words in (("Docs/Solvers.md", ("sagging_head.py materials", "sagging_head.py clamped",
                                                 "add a `<Loads>`")),
                            ("Docs/FuchsTetrahedralizer.md", ("In the ideal", "on earlier meshes")),
                            ("Docs/SimplexMesher.md", ("2.1 times",)),
                            ("Docs/Benchmarks.md", ("27 for 77 of 189",)),
                            ("Docs/SurgicalPathScale.md", ("straight lines", "smooth")),
                            *((page, ("65535",)) for page in ("README.md", "Docs/SimplexMesher.md",
                                                              "Docs/SurgicalPathScale.md")),
                            *((page, ("several layers",)) for page in ("README.md", "Docs/SimplexMesher.md")),
                            ("README.md", ("Windows", "no release yet"))):
            for word in words:
                self.assertIn(word, text_of(page), page)
        for page in PAGES:
            self.assertTrue(text_of(page).endswith("\n"), page)

    def test_the_example_installs_no_more_than_it_needs(self):
        self.assertIn("--for build,example", text_of("example.sh"))
        sections = re.split(r"^# \[(\w+)\].*\n", text_of("CMake", "debian-packages.txt"), flags=re.M)
        packages = {name: set(re.findall(r"^[\w.+-]+", text, re.M))
                    for name, text in zip(sections[1::2], sections[2::2])}
        self.assertEqual(set(packages), {"build", "example", "python", "site", "cohorts", "style", "tests"})
        self.assertFalse((packages["build"] | packages["example"]) & (packages["cohorts"] | packages["tests"]))
        self.assertTrue({"slurmctld", "freefem++", "libgtest-dev"} <= packages["tests"])

    def test_a_section_that_there_is_not_is_refused(self):
        done = subprocess.run([os.path.join(ROOT, "CMake", "build.sh"), "--for", "everything"], stderr=subprocess.PIPE,
                              stdout=subprocess.PIPE, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1))
        self.assertIn("build example python site cohorts style tests", done.stderr)

    def test_scripts_are_executable_bash(self):
        for script in ("example.sh", "test.sh", "CMake/build.sh", ".ci/run"):
            path = os.path.join(ROOT, script)
            self.assertTrue(os.access(path, os.X_OK), script)
            subprocess.run(["bash", "-n", path], check=True)

    def test_options_are_those_of_the_modules(self):
        sections = re.split(r"^### ", text_of("README.md"), flags=re.M)[1:4]
        for module, section in zip(MODULES, sections):
            flags, _ = options_of(module)
            for flag in re.findall(r"--(\w+)", section):
                self.assertIn(flag, flags, f"{module} in README.md")


class PagesTest(unittest.TestCase):
    def test_every_option_and_its_default_is_in_the_module_page(self):
        for module in [*MODULES, *PROGRAMS]:
            rows = re.findall(r"^\| `--(\w+)[^|]*\| *([^|]*?) *\|", section_of(module), re.M)
            flags, _ = options_of(module)
            self.assertEqual(len(rows), len(dict(rows)), f"{module}: an option is there twice")
            self.assertEqual(dict(rows), flags, module)

    def test_options_in_running_text_exist(self):
        known = {flag for module in [*MODULES, *PROGRAMS] for flag in options_of(module)[0]}
        known |= {flag for file in glob.glob(os.path.join(ROOT, "Program", "*.xml"))
                  for flag in re.findall(r"<longflag>(\w+)</longflag>", text_of(file))}
        known |= {"help", "version", "xml", "returnparameterfile", "quiet", "progress"}
        known.add("simplexMesherGradation")  # of `surgicalmesher mesh`, tried by test_program
        for page in PAGES:
            for flag in re.findall(r"`--(\w+)", text_of(page)):
                self.assertIn(flag, known, page)

    def test_positional_arguments_are_those_of_the_module(self):
        for module in [*MODULES, *PROGRAMS]:
            usage = re.search(rf"^    {module}CLI \[options\] (.*)$", section_of(module), re.M).group(1)
            self.assertEqual([word.split(".")[0] for word in usage.split()], options_of(module)[1], module)

    def test_links_lead_somewhere(self):
        for page in PAGES:
            for target in re.findall(r"\]\(([^)]+)\)", text_of(page)):
                if "://" in target:
                    continue
                file, _, anchor = target.partition("#")
                path = os.path.normpath(os.path.join(os.path.dirname(page), file)) if file else page
                self.assertTrue(os.path.exists(os.path.join(ROOT, path)), f"{target} in {page}")
                if anchor:
                    self.assertIn(anchor, anchors_of(path), f"{target} in {page}")

    def test_no_picture_is_cut_at_its_edge(self):
        """Titles were. Pictures of the application end where its window does."""
        for file in glob.glob(os.path.join(ROOT, "Docs", "images", "*.png")):
            if os.path.basename(file).startswith("tutorial-"):
                continue
            pixels = plt.imread(file)
            for edge in (pixels[0], pixels[-1], pixels[:, 0], pixels[:, -1]):
                self.assertTrue((edge == edge[0]).all(), file)

    def test_pictures_are_small_and_shown(self):
        shown = {os.path.normpath(os.path.join(os.path.dirname(page), target))
                 for page in PAGES for target in re.findall(r"!\[[^]]+\]\(([^)]+)\)", text_of(page))}
        there = {os.path.relpath(file, ROOT) for file in glob.glob(os.path.join(ROOT, "Docs", "images", "*"))}
        self.assertEqual(shown, there)
        for file in there:
            self.assertLess(os.path.getsize(os.path.join(ROOT, file)), 400_000, file)


if __name__ == "__main__":
    unittest.main()
