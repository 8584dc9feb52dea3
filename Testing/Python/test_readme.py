"""Every command in README.md is one that ./example.sh runs, and what else it names exists."""
import os
import re
import subprocess
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
MODULES = ("SurgicalPathScale", "SimplexMesher", "FuchsTetrahedralizer")


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


class ReadmeTest(unittest.TestCase):
    def test_every_fenced_block_is_tested(self):
        languages = re.findall(r"^```(\w*)\n.*?^```", text_of("README.md"), re.M | re.S)
        self.assertEqual(set(languages), {"sh"}, "a block in another language would go unchecked")

    def test_commands_are_those_of_the_example(self):
        commands = readme_commands()
        scripts = [command for command in commands if command.startswith("./")]
        self.assertEqual(scripts, ["./example.sh", "./test.sh"])
        self.assertEqual([command for command in commands if command not in scripts], example_commands())

    def test_scripts_are_executable_bash(self):
        for script in ("example.sh", "test.sh", "CMake/build.sh", ".ci/run"):
            path = os.path.join(ROOT, script)
            self.assertTrue(os.access(path, os.X_OK), script)
            subprocess.run(["bash", "-n", path], check=True)

    def test_options_are_those_of_the_modules(self):
        sections = re.split(r"^### ", text_of("README.md"), flags=re.M)[1:4]
        for module, section in zip(MODULES, sections):
            flags = set(re.findall(r"<longflag>(.*?)</longflag>", text_of(module, "CLI", module + "CLI.xml")))
            for flag in re.findall(r"--(\w+)", section):
                self.assertIn(flag, flags, f"{module} in README.md")

    def test_links_lead_somewhere(self):
        text = text_of("README.md")
        for target in re.findall(r"\]\(([^)]+)\)", text):
            if target.startswith("#"):
                headings = re.findall(r"^#+ (.*)$", text, re.M)
                anchors = [re.sub(r"[^\w -]", "", heading).lower().replace(" ", "-") for heading in headings]
                self.assertIn(target[1:], anchors)
            elif "://" not in target:
                self.assertTrue(os.path.exists(os.path.join(ROOT, target)), target)


if __name__ == "__main__":
    unittest.main()
