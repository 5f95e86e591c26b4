#!/usr/bin/env python3
"""Collects the pages of the documentation for mkdocs: docs_site.py ROOT GENERATED SITE.

The pages keep their paths below the repository, so that their links hold; files that they link to
are copied, and links to folders lead to the page of the folder. GENERATED holds the pages that
`mapproof generate docs` wrote. Ends with 1 and a line for each link or heading that is not there.
"""
import json
import pathlib
import posixpath
import re
import shutil
import sys

LINK = re.compile(r"(!?\[[^\]]*\])\(([^)\s]+)\)")
NAV = [
    ("Start", ["README.md", "docs/quick-start.md", "docs/which-command.md",
               "docs/troubleshooting.md", "examples/README.md"]),
    ("Use", ["docs/commands.md", "docs/file-formats.md", "docs/figures.md", "docs/report.md",
             "docs/your-results.md", "docs/evaluate.md", "docs/diff.md", "docs/diff-images.md",
             "docs/nightly.md", "docs/clusters.md", "docs/packages.md", "docs/library.md",
             "docs/python.md",
             "docs/limits.md"]),
    ("Methods", ["docs/methods-list.md", "docs/quantities.md"]),
    ("Schemas", ["docs/schemas/README.md"]),
    ("Project", ["docs/README.md", "docs/architecture.md", "docs/extending.md", "docs/testing.md",
                 "docs/stability.md", "docs/claims.md", "docs/decisions/README.md",
                 "SECURITY.md", "CONTRIBUTING.md", "CHANGELOG.md"]),
]


def slug(heading):
    """The anchor of a heading, as GitHub and mkdocs make it."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "")
    return re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", "-")


def without_code(text):
    """The text with its code blocks and inline code blanked, as long as before."""
    blank = lambda match: re.sub(r"[^\n]", " ", match.group())
    text = re.sub(r"^```.*?^```", blank, text, flags=re.M | re.S)
    text = re.sub(r"(?:(?<=\n\n)|\A)(?: {4}.*\n)+", blank, text)
    return re.sub(r"`[^`\n]*`", blank, text)


def anchors(text):
    found, counts = set(), {}
    for heading in re.findall(r"^#+ +(.*)$", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S), re.M):
        name = slug(heading)
        seen = counts.get(name, 0)
        counts[name] = seen + 1
        found.add(name if seen == 0 else f"{name}-{seen}")
    return found


def type_words(node, definitions):
    if "$ref" in node:
        name = node["$ref"].split("/")[-1]
        return f"[{name}](#{slug(name)})" if name in definitions else name
    if "const" in node:
        return f"`{json.dumps(node['const'])}`"
    if "enum" in node:
        return ", ".join(f"`{value}`" for value in node["enum"])
    kind = node.get("type", "any")
    words = " or ".join(kind) if isinstance(kind, list) else kind
    if words == "array" and isinstance(node.get("items"), dict):
        words = f"array of {type_words(node['items'], definitions)}"
    bounds = [f"{sign} {node[key]}" for key, sign in (
        ("minimum", "≥"), ("exclusiveMinimum", ">"), ("maximum", "≤"), ("exclusiveMaximum", "<"))
        if key in node]
    return ", ".join([words] + bounds)


def rows(node, definitions, prefix=""):
    required = node.get("required", [])
    for key, value in node.get("properties", {}).items():
        text = value.get("description", "").replace("|", "\\|").replace("\n", " ")
        default = f" Default: `{json.dumps(value['default'])}`." if "default" in value else ""
        needed = "yes" if key in required else ""
        words = type_words(value, definitions)
        yield f"| `{prefix}{key}` | {words} | {needed} | {text}{default} |"
        yield from rows(value, definitions, f"{prefix}{key}.")


def schema_page(file):
    schema = json.loads(file.read_text())
    definitions = schema.get("$defs", schema.get("definitions", {}))
    head = "\n| key | value | required | meaning |\n|---|---|---|---|\n"
    page = f"# {schema.get('title', file.name)}\n\n{schema.get('description', '')}\n\n"
    page += f"[{file.name}]({file.name})\n" + head + "\n".join(rows(schema, definitions)) + "\n"
    for name, node in definitions.items():
        lines = list(rows(node, definitions))
        page += f"\n## {name}\n\n{node.get('description', '')}\n"
        if lines:
            page += head + "\n".join(lines) + "\n"
        else:
            page += f"\n{type_words(node, definitions)}\n"
    return page


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def collect(root, generated):
    """All pages by their path; those of folders without one are lists."""
    found = {}
    for file in [*sorted(root.glob("*.md")), *sorted((root / "examples").rglob("*.md")),
                 *sorted((root / "docs").rglob("*.md"))]:
        found[file.relative_to(root)] = file.read_text()
    for file in sorted(generated.glob("*.md")):
        found[pathlib.Path("docs") / file.name] = file.read_text()
    listed = []
    for file in sorted((root / "docs/schemas").glob("*.schema.json")):
        page = pathlib.Path("docs/schemas") / (file.name.split(".")[0] + ".md")
        found[page] = schema_page(file)
        listed.append(f"- [{file.name.split('.')[0]}]({page.name})")
    found[pathlib.Path("docs/schemas/README.md")] = (
        "# Schemas\n\nThe files of mapproof, as JSON schemas: generated from their readers.\n\n"
        + "\n".join(listed) + "\n")
    return found


def main(root, generated, site):
    pages = collect(root, generated)
    folder = site / "pages"
    known = {page: anchors(text) for page, text in pages.items()}
    problems = []

    def target_of(page, link):
        """The link as it holds in the site."""
        path, _, anchor = link.partition("#")
        if re.match(r"[a-z]+:", link):
            return link
        target = page if not path else pathlib.Path(
            *pathlib.PurePosixPath(posixpath.normpath(str(page.parent / path))).parts)
        source = root / target
        if target not in pages and source.is_dir():
            target = target / "README.md"
            if target not in pages:
                names = sorted(item.name for item in source.iterdir())
                pages[target] = f"# {source.name}\n\n" + "".join(f"- [{n}]({n})\n" for n in names)
                known[target] = anchors(pages[target])
                for name in names:
                    if (source / name).is_file():
                        write_bytes(target.parent / name)
                write(folder / target, pages[target])
        elif target not in pages:
            if not source.is_file():
                problems.append(f"{page}: {link}: there is no such file")
                return link
            write_bytes(target)
        if anchor and target in known and anchor not in known[target]:
            problems.append(f"{page}: {link}: there is no such heading")
        up = pathlib.PurePosixPath(posixpath.relpath(str(target), str(page.parent))).as_posix()
        return (up if path else "") + ("#" + anchor if anchor else "")

    def write_bytes(path):
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(root / path, folder / path)

    for page, text in list(pages.items()):
        plain = without_code(text)
        out, last = [], 0
        for match in LINK.finditer(plain):
            out.append(text[last:match.start(2)])
            out.append(target_of(page, text[match.start(2):match.end(2)]))
            last = match.end(2)
        write(folder / page, "".join(out) + text[last:])
    methods = sorted(str(page) for page in pages if page.parts[:2] == ("docs", "methods"))
    schemas = sorted(str(page) for page in pages
                     if page.parts[:2] == ("docs", "schemas") and page.name != "README.md")
    nav = []
    for title, names in NAV:
        names = names + (methods if title == "Methods" else schemas if title == "Schemas" else [])
        nav.append({title: [name for name in names if pathlib.Path(name) in pages]})
    config = {"site_name": "mapproof", "docs_dir": str(folder), "nav": nav, "plugins": ["search"],
              "theme": {"name": "readthedocs", "highlightjs": False}, "use_directory_urls": False,
              "markdown_extensions": ["tables", "fenced_code", {"toc": {"permalink": True}}]}
    write(site / "mkdocs.yml", json.dumps(config, indent=2) + "\n")
    for problem in problems:
        print(f"docs: {problem}", file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(*(pathlib.Path(argument).resolve() for argument in sys.argv[1:4])))
