"""What only a process shows: exit status, streams, signals, files left behind.

Usage: test_runtime.py CommandLineTestModule
"""
import json
import os
import platform
import pty
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
import xml.dom.minidom

MODULE = os.path.abspath(sys.argv.pop(1))
LOADER = "/lib64/ld-linux-x86-64.so.2"


class Runtime(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.result = os.path.join(self.folder, "result.vtp")
        self.extra = os.path.join(self.folder, "extra.nii.gz")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def run_module(self, *arguments, **options):
        return subprocess.run([MODULE, *arguments], capture_output=True, text=True, timeout=120, **options)

    def act(self, what, *arguments, **options):
        return self.run_module("--act", what, "--extra", self.extra, *arguments, "in", self.result, **options)

    def assert_failure(self, done, status, message):
        """One line on stderr that says it, and no file."""
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertEqual(done.stderr, "CommandLineTestModule: " + message + "\n")
        self.assertEqual(os.listdir(self.folder), [])

    def test_success_writes_all_outputs_and_nothing_else(self):
        done = self.act("succeed", "--count", "2", "--text", "x")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(sorted(os.listdir(self.folder)), ["extra.nii.gz", "result.vtp"])
        with open(self.result) as file:
            self.assertEqual(file.read(), "x\nx\n6.750000 off\n")

    def test_outputs_get_the_permissions_of_any_new_file(self):
        self.act("succeed", preexec_fn=lambda: os.umask(0o027))
        self.assertEqual(os.stat(self.result).st_mode & 0o777, 0o640)

    def test_exit_statuses(self):
        self.assert_failure(self.act("inputError"), 1, "in: nothing found, something expected")
        self.assert_failure(self.act("usageError"), 2, "--act: 'usageError' found, something else expected")
        self.assert_failure(self.act("engineError"), 3, "stage two: gave up at (1, 2, 3) mm")
        self.assert_failure(self.act("outOfMemory"), 3, "out of memory")
        self.assert_failure(self.act("longException"), 3, "first line second line")
        self.assert_failure(self.act("number"), 3, "unknown failure of a library")

    def test_misuse_by_the_module_is_an_engine_failure(self):
        self.assertEqual(self.act("unknownName").returncode, 3)
        self.assertEqual(self.act("wrongType").returncode, 3)
        self.assert_failure(self.act("forget"), 3, self.result + ": output was not written")

    def test_libraries_are_silent_unless_asked(self):
        self.assertEqual(self.act("chatter").stderr, "")
        loud = self.act("chatter", env=dict(os.environ, SURGICALMESHER_DEBUG="1")).stderr
        self.assertIn("a library says something", loud)
        self.assertIn("and something else", loud)

    def test_xml_is_the_description_beside_the_source(self):
        done = self.run_module("--xml")
        source = os.path.join(os.path.dirname(os.path.abspath(__file__)), "CommandLineTestModule.xml")
        with open(source) as file:
            self.assertEqual(done.stdout, file.read())
        xml.dom.minidom.parseString(done.stdout)

    def test_help_and_version(self):
        self.assertEqual(self.run_module("--version").stdout, "CommandLineTestModule 1.2.3\n")
        for question in ("--help", "-h"):
            done = self.run_module(question)
            self.assertEqual(done.returncode, 0)
            self.assertIn("Usage: CommandLineTestModule [options] input result", done.stdout)

    def test_returned_values(self):
        file = os.path.join(self.folder, "r.params")
        done = self.act("succeed", "--returnparameterfile", file)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(file) as lines:
            self.assertEqual(lines.read(), "written = %d\n" % os.path.getsize(self.result))
        os.remove(file), os.remove(self.result), os.remove(self.extra)
        self.assert_failure(
            self.act("noReturnValue", "--returnparameterfile", file), 3, "no value for written was returned")

    def test_echo(self):
        done = self.act("succeed", "--echo", "--length=7")
        self.assertIn("\nlength: 7\n", done.stdout)
        self.assertIn("\nratio: 0.25\n", done.stdout)

    def test_progress_in_a_pipe(self):
        done = self.act("succeed", "--progress", "xml")
        comments = re.findall(r"<filter-comment>([^<]*)</filter-comment>", done.stdout)
        self.assertEqual(comments, [' "Writing &lt;all>" ', ' "Ending" '])
        progress = [float(value) for value in re.findall(r"<filter-progress>([^<]*)</filter-progress>", done.stdout)]
        self.assertEqual(progress, sorted(progress))
        self.assertEqual(progress[-1], 1)

    def test_hosts_get_tags_and_all_others_lines(self):
        plain = {name: value for name, value in os.environ.items() if name != "SLICER_HOME"}
        text = self.act("succeed", env=plain).stdout
        self.assertRegex(text, r"^  0 %  Writing <all>\n(.* %  Ending.*\n)+$")
        values = os.path.join(self.folder, "r.params")
        for tags in (self.act("succeed", env=dict(plain, SLICER_HOME="/somewhere")),
                     self.act("succeed", "--returnparameterfile", values, env=plain)):
            self.assertIn("<filter-progress>1</filter-progress>", tags.stdout)

    def test_progress_as_asked_for(self):
        done = self.act("warn", "--progress", "json")
        lines = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertEqual(lines[0], {"progress": 0, "stage": "Writing <all>"})
        self.assertEqual([line["progress"] for line in lines if "progress" in line][-1], 1)
        self.assertEqual([line["output"] for line in lines if "output" in line], [self.extra, self.result])
        self.assertIn({"message": 'a "message"'}, lines)
        self.assertIn({"warning": "something \\x1b odd"}, lines)
        self.assertEqual(self.act("warn", "--progress", "none").stdout, 'a "message"\n')
        self.assertEqual(self.act("warn", "--quiet").stdout, "")
        latin = os.path.join(self.folder, os.fsdecode(b"m\xfcller.vtp"))
        lines = [json.loads(line) for line in self.run_module("--progress", "json", "in", latin).stdout.splitlines()]
        self.assertIn({"output": latin}, lines)
        self.assert_failure_of_usage("--progress: 'bars' found, one of xml, bar, plain, json, none expected",
                                     "--progress", "bars")

    def assert_failure_of_usage(self, message, *arguments):
        done = self.run_module(*arguments, "in", self.result)
        self.assertEqual((done.returncode, done.stderr), (2, "CommandLineTestModule: " + message + "\n"))

    def test_warnings_go_to_stderr_but_for_hosts(self):
        line = "warning: something \\x1b odd\n"
        for arguments in ([], ["--quiet"], ["--progress", "json"]):
            done = self.act("warn", *arguments)
            self.assertEqual((done.returncode, done.stderr), (0, "CommandLineTestModule: " + line))
        done = self.act("warn", "--progress", "xml")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn(line, done.stdout)

    def test_b08_messages_are_printable(self):
        done = subprocess.run([MODULE, b"--act=inputError", b"a\xff\x1b[31m", self.result], capture_output=True)
        self.assertEqual(done.stderr,
                         b"CommandLineTestModule: a\\xff\\x1b[31m: nothing found, something expected\n")
        done = subprocess.run([MODULE, b"--\xfe\n", b"in", self.result], capture_output=True)
        self.assertEqual(done.returncode, 2)
        self.assertTrue(done.stderr.startswith(b"CommandLineTestModule: --\\xfe : unknown flag found"))

    def test_unknown_flags_name_the_nearest(self):
        def meant(flag):
            done = self.run_module(flag, "in", self.result)
            self.assertEqual(done.returncode, 2)
            return re.findall(r"did you mean (\S+)\?", done.stderr)

        self.assertEqual(meant("--lenght"), ["--length"])
        self.assertEqual(meant("-length=2"), ["--length"])
        self.assertEqual(meant("--LENGTH"), ["--length"])
        self.assertEqual(meant("--weight"), ["--weights"])
        self.assertEqual(meant("--quite"), ["--quiet"])
        self.assertEqual(meant("--nothing-like-it"), [])

    def test_progress_on_a_terminal(self):
        try:
            parent, child = pty.openpty()
        except OSError as error:
            self.skipTest(f"no pseudo-terminal here: {error}")
        done = subprocess.run([MODULE, "in", self.result], stdout=child, stderr=subprocess.PIPE, timeout=120)
        os.close(child)
        text = os.read(parent, 1 << 20).decode()
        os.close(parent)
        self.assertEqual(done.returncode, 0)
        self.assertRegex(text, r"\r\[#{30}\] 100 % Ending *\r?\n$")
        self.assertNotIn("<filter", text)

    def test_places_that_can_not_be_written_to(self):
        missing = os.path.join(self.folder, "missing")
        done = self.run_module("in", os.path.join(missing, "a.vtp"))
        self.assert_failure(
            done, 1, "%s/a.vtp: folder %s not found, a writable folder expected" % (missing, missing))
        taken = os.path.join(self.folder, "taken.vtp")
        os.mkdir(taken)
        done = self.run_module("--extra", self.extra, "in", taken)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(os.listdir(self.folder), ["taken.vtp"])

    def assert_kept(self, name, *arguments):
        """That the run is refused as a matter of the command line, and the file of this name is what it was."""
        file = os.path.join(self.folder, name)
        with open(file, "w") as stream:
            stream.write("precious")
        done = self.run_module(*arguments)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("too; another file expected\n", done.stderr)
        with open(file) as stream:
            self.assertEqual(stream.read(), "precious")

    def test_b02_no_input_is_replaced_whatever_its_option(self):
        result, other = self.result, os.path.join(self.folder, "list.vtp")
        self.assert_kept("result.vtp", "--start", result, "in", result)
        self.assert_kept("list.vtp", "--list", other, "in", other)
        self.assert_kept("list.vtp", "--list", "first," + other, "in", other)
        self.assert_kept("list.vtp", "--list", other, "--returnparameterfile", other, "in", result)
        self.assert_kept("result.vtp", "--returnparameterfile", result, result, other)
        self.assert_kept("result.vtp", "in", result, "--returnparameterfile", result)
        self.assertEqual(sorted(os.listdir(self.folder)), ["list.vtp", "result.vtp"])

    def test_b02_no_sidecar_replaces_an_input_or_another_output(self):
        sidecar, piece = self.result + ".json", os.path.join(self.folder, "result.part_1.vtp")
        self.assert_kept("result.vtp.json", "--act", "sidecars", sidecar, self.result)
        self.assert_kept("result.vtp.json", "--act", "sidecars", "--list", sidecar, "in", self.result)
        self.assert_kept("result.vtp.json", "--act", "sidecars", "--returnparameterfile", sidecar, "in", self.result)
        os.remove(sidecar)
        with open(piece, "w") as stream:
            stream.write("precious")
        link = os.path.join(self.folder, "link")
        os.link(piece, link)
        for inputs in ([piece], [link], ["--list", piece, "in"]):
            done = self.run_module("--act", "sidecars", *inputs, self.result)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("one file per tissue, result.part_....vtp, may be written to", done.stderr)
        with open(piece) as stream:
            self.assertEqual(stream.read(), "precious")
        done = self.run_module("--act", "sidecars", "--returnparameterfile", piece, "in", self.result)
        self.assertEqual(done.returncode, 2, done.stderr)

    def test_b02_one_file_by_two_paths(self):
        os.mkdir(os.path.join(self.folder, "a"))
        os.symlink(os.path.join(self.folder, "a"), os.path.join(self.folder, "b"))
        done = self.run_module("--returnparameterfile", self.folder + "/a/x.vtp", "in", self.folder + "/b/x.vtp")
        self.assertEqual(done.returncode, 2, done.stderr)

    def test_an_input_of_another_kind_is_no_output(self):
        with open(self.result, "w") as file:
            file.write("precious")
        done = self.run_module(self.result, self.result)
        self.assertEqual(done.returncode, 2)
        link = os.path.join(self.folder, "link.vtp")
        os.symlink(self.result, link)
        self.assertEqual(self.run_module(link, self.result).returncode, 2)
        with open(self.result) as file:
            self.assertEqual(file.read(), "precious")

    def test_one_file_for_two_outputs_is_refused(self):
        same = os.path.join(self.folder, "a.nrrd.vtp")
        os.symlink(same, os.path.join(self.folder, "link.nrrd"))
        self.assertEqual(self.run_module("--extra", self.folder + "/link.nrrd", "in", same).returncode, 2)

    def test_a_write_that_fails_half_way(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)

        done = self.act("succeed", "--count", "10000", preexec_fn=limit, restore_signals=False)
        self.assert_failure(done, 1, self.result + ": can't be written")

    def test_a_full_disk(self):
        script = (
            'mount -t tmpfs -o size=64k none "$1" || exit 99; shift; "$@"; status=$?; ls -A "$0" >&2; exit $status')
        allowed = subprocess.run(["unshare", "-rm", "true"], capture_output=True, text=True, timeout=120)
        if allowed.returncode != 0:
            self.skipTest("no small file system can be mounted here: " + allowed.stderr.strip())
        done = subprocess.run(
            ["unshare", "-rm", "sh", "-c", script, self.folder, self.folder,
             MODULE, "--count", "100000", "in", self.result],
            capture_output=True, text=True, timeout=120)
        if done.returncode not in (0, 1, 2, 3):
            self.skipTest("no small file system can be mounted here: " + done.stderr.strip())
        self.assertEqual(done.returncode, 1)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)

    @unittest.skipUnless(os.path.exists("/dev/full"), "only Linux has it")
    def test_stdout_without_room(self):
        message = "CommandLineTestModule: stdout: not all that was printed could be written, a place with room for it expected\n"
        for arguments in (["--help"], ["--xml"], ["--version"], ["--echo", "in", self.result], ["in", self.result]):
            with open("/dev/full", "w") as full:
                done = subprocess.run([MODULE, *arguments], stdout=full, stderr=subprocess.PIPE, text=True, timeout=120)
            self.assertEqual((done.returncode, done.stderr), (3, message), arguments)
        self.assertEqual(os.listdir(self.folder), ["result.vtp"])
        read, write = os.pipe()
        os.close(read)
        for ignored, status in ((False, -signal.SIGPIPE), (True, 0)):
            action = signal.SIG_IGN if ignored else signal.SIG_DFL
            done = subprocess.run([MODULE, "--help"], stdout=write, stderr=subprocess.PIPE, restore_signals=False,
                                  preexec_fn=lambda: signal.signal(signal.SIGPIPE, action))
            self.assertEqual((done.returncode, done.stderr), (status, b""))
        os.close(write)

    def wait_for_half(self, folder, prepare=None, result=None, environment=None):
        process = subprocess.Popen(
            [MODULE, "--act", "wait", "--extra", self.extra, "in", result or self.result], stdout=subprocess.PIPE,
            stderr=subprocess.PIPE, text=True, preexec_fn=prepare, env=environment)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        for line in process.stdout:
            if line == "waiting\n":
                break
        self.assertEqual(len(os.listdir(folder)), 2)
        return process

    def end(self, process, how):
        process.send_signal(how)
        process.wait(timeout=60)
        self.assertEqual(process.returncode, -how)

    def test_cancelled_half_way(self):
        for how in (signal.SIGTERM, signal.SIGINT):
            self.end(self.wait_for_half(self.folder), how)
            self.assertEqual(os.listdir(self.folder), [])

    def test_b13_whatever_ends_a_run_leaves_nothing(self):
        for how in (signal.SIGHUP, signal.SIGQUIT, signal.SIGPIPE, signal.SIGSEGV, signal.SIGABRT, signal.SIGBUS,
                    signal.SIGFPE, signal.SIGILL, signal.SIGUSR1, signal.SIGALRM):
            with self.subTest(how):
                self.end(self.wait_for_half(self.folder), how)
                self.assertEqual(os.listdir(self.folder), [])

    def test_b13_a_stack_used_up_leaves_nothing(self):
        done = self.act("recurse")
        self.assertEqual(done.returncode, -signal.SIGSEGV)
        self.assertEqual(os.listdir(self.folder), [])
        self.assertRegex(done.stderr, r"^CommandLineTestModule: crashed .*, no output was written\n$")

    def test_b13_a_closed_pipe_leaves_nothing(self):
        read, write = os.pipe()
        os.close(read)
        done = subprocess.run([MODULE, "--progress", "xml", "in", self.result], stdout=write, stderr=subprocess.PIPE)
        os.close(write)
        self.assertEqual((done.returncode, done.stderr), (-signal.SIGPIPE, b""))
        self.assertEqual(os.listdir(self.folder), [])

    def test_b13_a_file_that_may_not_grow_is_said(self):
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
        done = self.act("succeed", "--count", "10000", preexec_fn=limit)
        self.assert_failure(done, 1, self.result + ": can't be written")

    def test_b13_a_hang_up_that_is_ignored_stays_ignored(self):
        process = self.wait_for_half(self.folder, lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        process.send_signal(signal.SIGHUP)
        self.end(process, signal.SIGTERM)

    def test_an_interrupted_run_says_so(self):
        process = self.wait_for_half(self.folder)
        self.end(process, signal.SIGINT)
        self.assertEqual(process.stderr.read(), "CommandLineTestModule: interrupted, no output was written\n")

    def test_b13_another_run_removes_what_a_kill_left(self):
        self.end(self.wait_for_half(self.folder), signal.SIGKILL)
        self.assertEqual(len(os.listdir(self.folder)), 2)
        other = os.path.join(self.folder, "other.vtp")
        self.assertEqual(self.run_module("in", other).returncode, 0)
        self.assertEqual(os.listdir(self.folder), ["other.vtp"])

    def test_b15_names_as_long_as_the_system_takes(self):
        # Behind 0 to 2 bytes, so that the cut falls into a character whatever the length of the process's number.
        for letters, before in (("x", ""), ("é", ""), ("é", "x"), ("脳", ""), ("脳", "x"), ("脳", "xx")):
            name = before + letters * ((255 - 4 - len(before)) // len(letters.encode())) + ".vtp"
            result = os.path.join(self.folder, name)
            done = self.run_module("in", result)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual(os.listdir(self.folder), [name])
            os.remove(result)
            self.end(self.wait_for_half(self.folder, result=result), signal.SIGKILL)
            self.assertEqual(len(os.listdir(self.folder)), 2)
            self.assertEqual(self.run_module("in", result).returncode, 0)
            self.assertEqual(os.listdir(self.folder), [name])
            os.remove(result)

    @staticmethod
    def environment_of(process):
        with open("/proc/%d/environ" % process.pid, "rb") as file:
            return file.read().split(b"\0")

    @staticmethod
    def with_tunables(value):
        others = {name: text for name, text in os.environ.items() if name != "GLIBC_TUNABLES"}
        return others if value is None else dict(others, GLIBC_TUNABLES=value)

    @unittest.skipUnless(platform.libc_ver()[0] == "glibc", "only glibc is told so")
    def test_large_pages_are_asked_for_in_the_same_process(self):
        process = self.wait_for_half(self.folder, environment=self.with_tunables(None))
        self.assertIn(b"GLIBC_TUNABLES=glibc.malloc.hugetlb=1", self.environment_of(process))
        with open("/proc/%d/comm" % process.pid) as file:
            self.assertEqual(file.read().strip(), os.path.basename(MODULE)[:15])
        self.end(process, signal.SIGTERM)

    @unittest.skipUnless(platform.libc_ver()[0] == "glibc", "only glibc is told so")
    def test_tunables_of_the_user_stay(self):
        process = self.wait_for_half(self.folder, environment=self.with_tunables("glibc.malloc.perturb=1"))
        self.assertIn(b"GLIBC_TUNABLES=glibc.malloc.perturb=1", self.environment_of(process))
        self.end(process, signal.SIGTERM)

    @unittest.skipUnless(os.path.exists(LOADER), "another loader")
    def test_run_by_the_loader(self):
        done = subprocess.run([LOADER, MODULE, "--act", "succeed", "--count", "1", "--text", "", "in", self.result],
                              capture_output=True, text=True, timeout=120, env=self.with_tunables(None))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        with open(self.result) as file:
            self.assertTrue(file.read().startswith("\n"))  # words that are empty are words

    def test_killed_half_way_and_run_again(self):
        self.end(self.wait_for_half(self.folder), signal.SIGKILL)
        left = os.listdir(self.folder)
        self.assertEqual(len(left), 2)
        for name in left:
            self.assertRegex(name, r"^\.(result\.vtp\..*\.partial\.vtp|extra\.nii\.gz\..*\.partial\.nii\.gz)$")
        self.assertEqual(self.act("succeed").returncode, 0)
        self.assertEqual(sorted(os.listdir(self.folder)), ["extra.nii.gz", "result.vtp"])

    def test_two_runs_at_once_do_not_disturb_each_other(self):
        first = self.wait_for_half(self.folder)
        self.assertEqual(self.act("succeed").returncode, 0)
        self.assertEqual(len(os.listdir(self.folder)), 4)
        self.end(first, signal.SIGTERM)
        self.assertEqual(sorted(os.listdir(self.folder)), ["extra.nii.gz", "result.vtp"])


if __name__ == "__main__":
    unittest.main()
