"""spdx.py DEB...: an SPDX 2.3 file, as JSON, of Debian packages and of what they are made of.

The libraries are those of scripts/dependencies.txt, each with the version that dpkg-query has of its
package, and the packages that DEB depends on. The date is that of SOURCE_DATE_EPOCH.
"""

import datetime
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def field(deb, name):
    return subprocess.run(["dpkg-deb", "-f", deb, name], check=True, capture_output=True,
                          text=True).stdout.strip()


def installed_version(package):
    """Of an installed Debian package; empty if it is not."""
    found = subprocess.run(
        ["dpkg-query", "-W", "-f", "${db:Status-Status} ${Version}\n", package],
        capture_output=True, text=True)
    words = found.stdout.split()
    return words[1] if len(words) > 1 and words[0] == "installed" else ""


def package_element(name, version, licence):
    element = {
        "SPDXID": "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", name),
        "name": name,
        "downloadLocation": "NOASSERTION",
        "filesAnalyzed": False,
        "licenseConcluded": "NOASSERTION",
        "licenseDeclared": licence,
        "copyrightText": "NOASSERTION",
    }
    if version:
        element["versionInfo"] = version
    return element



def dependencies():
    """The libraries: element, and how mapproof uses them."""
    for line in (ROOT / "scripts/dependencies.txt").read_text(encoding="utf-8").splitlines():
        if not line or line.startswith("#"):
            continue
        name, licence, packages, use = [part.strip() for part in line.split(";")]
        versions = [(package, installed_version(package)) for package in packages.split("|")]
        package, version = next((v for v in versions if v[1]), (packages.split("|")[0], ""))
        element = package_element(package, version, licence)
        element["summary"] = name
        yield element, use


def relation(one, kind, other):
    return {"spdxElementId": one, "relationshipType": kind, "relatedSpdxElement": other}


KINDS = {"headers": "CONTAINS", "embedded": "CONTAINS", "linked": "DEPENDS_ON",
         "scenes": "DEPENDS_ON", "animation": "DEPENDS_ON"}


def document(debs):
    elements, relations = {}, []
    for deb in sorted(debs):
        name = field(deb, "Package")
        element = package_element(name, field(deb, "Version"), "MIT")
        element["packageFileName"] = os.path.basename(deb)
        digest = hashlib.sha256(pathlib.Path(deb).read_bytes()).hexdigest()
        element["checksums"] = [{"algorithm": "SHA256", "checksumValue": digest}]
        elements[name] = element
        relations.append(relation("SPDXRef-DOCUMENT", "DESCRIBES", element["SPDXID"]))
    for deb in sorted(debs):
        name = field(deb, "Package")
        for alternatives in field(deb, "Depends").split(","):
            needed = alternatives.split("|")[0].split("(")[0].split(":")[0].strip()
            if not needed:
                continue
            if needed not in elements:
                elements[needed] = package_element(needed, installed_version(needed), "NOASSERTION")
            relations.append(relation("SPDXRef-" + name, "DEPENDS_ON", elements[needed]["SPDXID"]))
    for element, use in dependencies():
        elements.setdefault(element["name"], element).update(element)
        relations.append(relation("SPDXRef-mapproof", KINDS[use], element["SPDXID"]))
    digest = hashlib.sha256(json.dumps([elements, relations], sort_keys=True).encode()).hexdigest()
    date = datetime.datetime.fromtimestamp(int(os.environ.get("SOURCE_DATE_EPOCH", "0")),
                                           datetime.timezone.utc)
    return {
        "spdxVersion": "SPDX-2.3",
        "dataLicense": "CC0-1.0",
        "SPDXID": "SPDXRef-DOCUMENT",
        "name": "mapproof",
        "documentNamespace": "https://spdx.org/spdxdocs/mapproof-" + digest,
        "creationInfo": {"created": date.strftime("%Y-%m-%dT%H:%M:%SZ"),
                         "creators": ["Tool: mapproof-scripts-package"]},
        "packages": list(elements.values()),
        "relationships": relations,
    }


json.dump(document(sys.argv[1:]), sys.stdout, indent=1, ensure_ascii=False)
print()
