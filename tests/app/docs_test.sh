#!/usr/bin/env bash
# docs_test.sh PROGRAM ROOT WORK: the pages of scripts/docs, collected without mkdocs.
set -euo pipefail
rm -rf "$3"
"$1" generate docs --out "$3/generated"
python3 "$2/scripts/docs_site.py" "$2" "$3/generated" "$3/site"
for page in commands methods-list quantities schemas/experiment; do
  grep -q '|' "$3/site/pages/docs/$page.md" || { echo "$page has no table"; exit 1; }
done
