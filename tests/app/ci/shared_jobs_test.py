"""Runs every step of the GitHub action and the GitLab component against a repository made here.

apt-get, curl and sudo are stand-ins: apt-get "installs" the program under test from the package that
it is given. `scripts/check package` installs a real one.
"""

import os
import pathlib
import re
import stat
import subprocess

import pytest
import yaml

ROOT = pathlib.Path(os.environ["MAPPROOF_SOURCE_DIR"])
PROGRAM = os.environ["MAPPROOF_PROGRAM"]
ACTION = ROOT / "examples/ci/action/action.yml"
COMPONENT = ROOT / "examples/ci/gitlab-component.yml"
EXPERIMENT = str(ROOT / "tests/data/experiments/small.json")


def write_program(path, text):
    path.write_text("#!/bin/bash\nset -eu\n" + text)
    path.chmod(path.stat().st_mode | stat.S_IXUSR)


class Machine:
    """A machine without mapproof, and a clone whose plot differs from its origin's."""

    def __init__(self, folder):
        self.folder = folder
        self.bin = folder / "bin"
        self.bin.mkdir()
        (folder / "mapproof.deb").write_text("a package")
        write_program(self.bin / "sudo", '"$@"\n')
        write_program(self.bin / "curl", f'cp {folder}/mapproof.deb "${{@: -2:1}}"\n')
        write_program(self.bin / "apt-get", f"""echo "$*" >>{folder}/apt.log
for file; do
  if [[ $file == /* ]]; then
    grep -q 'a package' "$file"
    printf '#!/bin/sh\\nexec {PROGRAM} "$@"\\n' >{self.bin}/mapproof
    chmod +x {self.bin}/mapproof
  fi
done
""")
        self.clone = folder / "clone"
        self.make_repository()

    def make_repository(self):
        origin = self.folder / "origin"
        (origin / "plots").mkdir(parents=True)
        plot = (ROOT / "examples/plots/old").glob("*.svg")
        (origin / "plots/plot.svg").write_text(next(plot).read_text())
        git = ["git", "-c", "user.name=S", "-c", "user.email=s@example.org"]
        subprocess.run([*git, "init", "-q", "-b", "main", "."], cwd=origin, check=True)
        subprocess.run([*git, "add", "-A"], cwd=origin, check=True)
        subprocess.run([*git, "commit", "-q", "-m", "Plots"], cwd=origin, check=True)
        subprocess.run(["git", "clone", "-q", origin, self.clone], check=True)
        text = (self.clone / "plots/plot.svg").read_text()
        (self.clone / "changed").mkdir()
        changed = re.sub(r'stroke="#\w+"|fill="#\w+"', 'fill="#123456"', text)
        assert changed != text
        (self.clone / "changed/plot.svg").write_text(changed)

    def run(self, script, variables):
        environment = dict(os.environ, PATH=f"{self.bin}:/usr/bin:/bin", **variables)
        return subprocess.run(["bash", "-e", "-o", "pipefail", "-c", script], cwd=self.clone,
                              env=environment, capture_output=True, text=True)


class Hub:
    """The composite action: its steps with the inputs filled in."""

    def __init__(self, machine):
        self.machine = machine
        self.action = yaml.safe_load(ACTION.read_text())
        self.summary = machine.folder / "summary.md"

    def defaults(self):
        return {name: value.get("default") for name, value in self.action["inputs"].items()}

    def job(self, **inputs):
        inputs = {**self.defaults(), **inputs}
        for step in self.action["runs"]["steps"]:
            assert step["shell"] == "bash"
            if "if" in step and not inputs["package"]:
                assert step["if"] == "inputs.package != ''"
                continue
            variables = {key: re.sub(r"\$\{\{ inputs\.(\w+) \}\}", lambda m: inputs[m[1]], value)
                         for key, value in step["env"].items()}
            done = self.machine.run(step["run"],
                                    {"GITHUB_STEP_SUMMARY": str(self.summary), **variables})
            if done.returncode:
                return done
        return done


class Lab:
    """The component: its job with the inputs filled in."""

    def __init__(self, machine):
        self.machine = machine
        head, self.body = COMPONENT.read_text().split("\n---\n")
        self.inputs = yaml.safe_load(head)["spec"]["inputs"]

    def defaults(self):
        return {name: value.get("default") for name, value in self.inputs.items()}

    def job(self, **inputs):
        inputs = {**self.defaults(), **inputs}
        if inputs["command"] not in self.inputs["command"]["options"]:
            return subprocess.CompletedProcess([], 2, "", "GitLab refuses the input")
        text = re.sub(r"\$\[\[ inputs\.(\w+) \]\]", lambda m: inputs[m[1]], self.body)
        job = yaml.safe_load(text)[inputs["job"]]
        for line in [*job["before_script"], *job["script"]]:
            done = self.machine.run(line, job["variables"])
            if done.returncode:
                return done
        return done


@pytest.fixture(params=[Hub, Lab])
def host(request, tmp_path):
    return request.param(Machine(tmp_path))


def test_a_package_is_installed_by_path_or_url(host):
    for package in ("../mapproof.deb", "https://example.org/mapproof.deb"):
        (host.machine.bin / "mapproof").unlink(missing_ok=True)
        done = host.job(package=package, command="diff", arguments="plots plots")
        assert done.returncode == 0, done.stderr
    assert "install" in (host.machine.folder / "apt.log").read_text()


def test_diff_fails_where_a_figure_changed_and_leaves_its_page(host):
    same = host.job(package="../mapproof.deb", command="diff", arguments="plots plots")
    assert same.returncode == 0, same.stderr
    done = host.job(command="diff", arguments="plots changed")
    assert done.returncode == 1, done.stderr
    for name in ("diff.html", "diff.junit.xml", "images"):
        assert (host.machine.clone / "out/mapproof" / name).exists()
    if isinstance(host, Hub):
        assert "plot" in host.summary.read_text()


def test_check_runs_a_command_whose_words_are_quoted(host):
    arguments = "--baseline-ref origin/main:plots -- cp '{}/plot.svg' ."
    clone = host.machine.clone
    (clone / "same plots").mkdir()
    (clone / "same plots/plot.svg").write_text((clone / "plots/plot.svg").read_text())
    same = host.job(package="../mapproof.deb", command="check",
                    arguments=arguments.format(clone / "same plots"))
    assert same.returncode == 0, same.stderr
    done = host.job(command="check", arguments=arguments.format(clone / "changed"))
    assert done.returncode == 1, done.stderr


def test_nightly_adds_a_run_to_the_history(host):
    done = host.job(package="../mapproof.deb", command="nightly",
                    arguments=f"{EXPERIMENT} --profile tiny")
    assert done.returncode == 0, done.stderr
    assert (host.machine.clone / "out/mapproof/history.sqlite").exists()


def test_other_commands_are_refused(host):
    assert host.job(package="../mapproof.deb", command="remove").returncode == 2
