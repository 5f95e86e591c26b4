"""spdx_check.py FILE: whether an SPDX file of scripts/deb/spdx.py is whole; else what is wrong."""

import json
import re
import sys

document = json.load(open(sys.argv[1], encoding="utf-8"))
ids = [element["SPDXID"] for element in document["packages"]]
problems = []
if document["spdxVersion"] != "SPDX-2.3" or document["dataLicense"] != "CC0-1.0":
    problems.append("the version or the licence of the data")
if len(set(ids)) != len(ids):
    problems.append("two elements have one id")
for element in ids:
    if not re.fullmatch(r"SPDXRef-[A-Za-z0-9.-]+", element):
        problems.append(f"{element} is not an id")
for relation in document["relationships"]:
    for end in (relation["spdxElementId"], relation["relatedSpdxElement"]):
        if end != "SPDXRef-DOCUMENT" and end not in ids:
            problems.append(f"{end} is not in the file")
for element in document["packages"]:
    if not element.get("versionInfo") and element["licenseDeclared"] != "NOASSERTION":
        problems.append(f"{element['name']} has no version")
for problem in problems:
    print(f"spdx: {problem}", file=sys.stderr)
sys.exit(1 if problems else 0)
