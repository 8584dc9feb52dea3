"""A module's XML, its parser and its source agree.

Usage: test_description.py EXECUTABLE SOURCE.cxx

For every parameter in the XML that EXECUTABLE prints: a legal value is accepted and comes back, an illegal one is
refused, --help lists it, and SOURCE.cxx, or a header beside it that it includes, asks for it. They ask for nothing
else.
"""
import os
import re
import subprocess
import sys
import tempfile
import unittest
import xml.dom.minidom

SOURCE = os.path.abspath(sys.argv.pop(2))
EXECUTABLE = os.path.abspath(sys.argv.pop(1))

ACCESSORS = "given|flag|integer|number|text|texts|numbers|points|outputFile|outputFiles|outputNames|returnValue"


def run(*arguments):
    return subprocess.run([EXECUTABLE, *arguments], capture_output=True, text=True, timeout=60)


def source_with_headers():
    with open(SOURCE) as file:
        text = file.read()
    for name in re.findall(r'(?m)^#include "(\w+\.h)"', text):
        header = os.path.join(os.path.dirname(SOURCE), name)
        if os.path.exists(header):
            with open(header) as file:
                text += file.read()
    return text


class Parameter:
    def __init__(self, element):
        self.type = element.tagName
        self.name = self.child(element, "name")
        flag = self.child(element, "longflag")
        self.flag = "--" + flag.lstrip("-") if flag else None
        self.index = self.child(element, "index")
        self.default = self.child(element, "default")
        self.minimum, self.maximum = self.child(element, "minimum"), self.child(element, "maximum")
        self.choices = [choice.firstChild.data for choice in element.getElementsByTagName("element")]
        self.output = self.child(element, "channel") == "output"
        self.extension = element.getAttribute("fileExtensions").split(",")[0]

    @staticmethod
    def child(element, name):
        found = element.getElementsByTagName(name)
        return found[0].firstChild.data.strip() if found and found[0].firstChild else None

    def legal(self):
        """A value other than the default where there is one."""
        if self.choices:
            return self.choices[-1]
        if self.type in ("integer", "double", "float"):
            # Ranges include their ends.
            return next(limit for limit in (self.maximum, self.minimum, "7") if limit and limit != self.default)
        if self.type.endswith("-vector"):
            return "3,4"
        return {"point": "1,-2,3.5", "region": "1,2,3,4,5,6", "string": "some text"}.get(
            self.type, "nowhere/file" + self.extension)

    def illegal(self):
        values = ["", "x" if not self.choices else self.choices[0] + "x"]
        if self.type in ("integer", "double", "float"):
            values += ["nan", "inf", "1e999", self.legal() + "x"]
            values += [str(float(self.minimum) - 1)] if self.minimum else []
            values += [str(float(self.maximum) + 1)] if self.maximum else []
        if self.type == "integer":
            values.append("1.5")
        if self.type == "string":
            return []
        if self.type in ("file", "directory", "image", "geometry", "table", "transform", "measurement", "pointfile"):
            return [""] + (["nowhere/file.wrong"] if self.output and self.extension else [])
        return values


class Description(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.xml = run("--xml").stdout
        document = xml.dom.minidom.parseString(cls.xml)
        cls.parameters = [
            Parameter(element) for group in document.getElementsByTagName("parameters") for element in group.childNodes
            if element.nodeType == element.ELEMENT_NODE and element.tagName not in ("label", "description")]
        cls.options = [parameter for parameter in cls.parameters if parameter.flag]
        cls.positionals = sorted((p for p in cls.parameters if p.index), key=lambda p: int(p.index))

    def echo(self, *arguments):
        """Runs on an input that does not exist, so that nothing but the command line is looked at."""
        with tempfile.TemporaryDirectory() as folder:
            files = [os.path.join(folder, "missing", p.name + p.extension) for p in self.positionals]
            return run("--echo", *arguments, *files)

    def test_xml_is_that_beside_the_source(self):
        with open(os.path.splitext(SOURCE)[0] + ".xml") as file:
            self.assertEqual(self.xml, file.read())
        self.assertTrue(self.xml.startswith("<?xml"))

    def test_legal_values_come_back(self):
        self.assertTrue(self.options)
        for parameter in self.options:
            with self.subTest(parameter.name):
                if parameter.type == "boolean":
                    value, words = ("false" if parameter.default == "true" else "true"), [parameter.flag]
                else:
                    value = parameter.legal()
                    words = [parameter.flag, value]
                self.assertIn("\n%s: %s\n" % (parameter.name, value), "\n" + self.echo(*words).stdout)
                self.assertNotIn("\n%s: %s\n" % (parameter.name, value), "\n" + self.echo().stdout)

    def test_illegal_values_are_refused(self):
        for parameter in self.options:
            if parameter.type == "boolean":
                continue
            for value in parameter.illegal():
                with self.subTest(parameter.name, value=value):
                    done = self.echo(parameter.flag + "=" + value)
                    self.assertEqual((done.returncode, done.stdout), (2, ""))
                    self.assertIn(parameter.flag + ": '%s' found" % value, done.stderr)
                    self.assertEqual(done.stderr.count("\n"), 1)

    def test_help_lists_all(self):
        text = run("--help").stdout
        for parameter in self.parameters:
            self.assertRegex(text, r"(?m)^  %s\b" % (parameter.flag or parameter.name))
            if parameter.default and parameter.flag and parameter.type != "boolean":
                self.assertRegex(" ".join(text.split()), r"default %s\b" % re.escape(parameter.default))

    def test_source_and_xml_name_the_same_parameters(self):
        asked = set(re.findall(r"[.>](?:%s)\(\s*\"(\w+)\"" % ACCESSORS, source_with_headers()))
        self.assertEqual(asked, {parameter.name for parameter in self.parameters})


if __name__ == "__main__":
    unittest.main()
