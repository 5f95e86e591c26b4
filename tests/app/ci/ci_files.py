"""Checks the project's CI files: YAML, jobs, and that every step is a script of the project.

python3 ci_files.py ROOT: one line for each thing that is wrong, and exit code 1; else the steps.
"""

import pathlib
import re
import shlex
import sys

try:
    import yaml
except ImportError:
    sys.exit(77)

ROOT = pathlib.Path(sys.argv[1])
PROBLEMS = []


def require(holds, text):
    if not holds:
        PROBLEMS.append(text)


def load(name):
    return yaml.safe_load((ROOT / name).read_text(encoding="utf-8"))


def help_of(words):
    """The comment at the top of a script; of scripts/check the paragraph of the check."""
    comment = []
    for line in (ROOT / words[0]).read_text(encoding="utf-8").splitlines()[1:]:
        if not line.startswith("#"):
            break
        comment.append(line[1:])
    if words[0] != "scripts/check":
        return "\n".join(comment), 1
    paragraph, inside = [], False
    for line in comment:
        if re.match(r"   [a-z]", line):
            inside = line.split()[0] == words[1]
        if inside:
            paragraph.append(line)
    return "\n".join(paragraph), 2


def check_step(where, line):
    words = shlex.split(line)
    script = ROOT / words[0]
    require(words[0].startswith("scripts/"), f"{where}: {line}: is not a script of the project")
    if not script.is_file():
        PROBLEMS.append(f"{where}: there is no {words[0]}")
        return
    require(script.stat().st_mode & 0o111, f"{where}: {words[0]} is not executable")
    text, first = help_of(words)
    require(text, f"{where}: {line}: there is no such check")
    for word in words[first:]:
        if word.startswith("-"):
            require(re.search(re.escape(word) + r"\b", text), f"{where}: {line}: no option {word}")


def steps_of_hub(name):
    for job, content in load(name)["jobs"].items():
        for step in content["steps"]:
            where = f"{name}, {job}"
            if "uses" in step:
                require(re.fullmatch(r"actions/[a-z/-]+@v\d+", step["uses"]), f"{where}: {step}")
            for line in step.get("run", "").splitlines():
                yield where, line


def steps_of_lab(name):
    for job, content in load(name).items():
        if isinstance(content, dict):
            for line in content.get("script", []):
                yield f"{name}, {job}", line


def check_jobs():
    change = load(".github/workflows/change.yml")
    nightly = load(".github/workflows/nightly.yml")
    lab = load(".gitlab-ci.yml")
    systems = {"debian:12", "debian:13", "ubuntu:24.04"}
    matrix = change["jobs"]["test"]["strategy"]["matrix"]
    require(set(matrix["image"]) == systems, "GitHub: the systems of the tests")
    require(any("arm" in runner for runner in matrix["runner"]), "GitHub: no arm64")
    cells = lab["test"]["parallel"]["matrix"][0]
    require(set(cells["IMAGE"]) == systems, "GitLab: the systems of the tests")
    require(any("arm64" in runner for runner in cells["RUNNER"]), "GitLab: no arm64")
    # "on" is a Boolean in YAML 1.1.
    require("schedule" in nightly[True], "GitHub: no schedule of the nightly run")
    require({"test", "sanitize", "figures"} <= set(change["jobs"]), "GitHub: jobs of a change")
    require({"test", "sanitize", "figures", "pages"} <= set(lab), "GitLab: jobs")
    require(nightly["jobs"]["pages"]["needs"] == "nightly", "GitHub: the pages of the nightly run")
    checkout = change["jobs"]["figures"]["steps"][0]["with"]
    require(checkout["fetch-depth"] == 0, "GitHub: figures need the history")
    require(lab["figures"]["variables"]["GIT_DEPTH"] == 0, "GitLab: figures need the history")


def main():
    check_jobs()
    steps = [*steps_of_hub(".github/workflows/change.yml"),
             *steps_of_hub(".github/workflows/nightly.yml"), *steps_of_lab(".gitlab-ci.yml")]
    for where, line in steps:
        check_step(where, line)
    require(len(steps) >= 8, "the steps of the CI were not found")
    for text in PROBLEMS or sorted({line for _, line in steps}):
        print(text)
    sys.exit(1 if PROBLEMS else 0)


main()
