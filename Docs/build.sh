#!/usr/bin/env bash
# Builds the documentation as a site in FOLDER/html. Ends with status 1 if a page, or the target of a link, is missing.
# usage: Docs/build.sh [FOLDER]   (default build-site)
set -euo pipefail
folder=$(realpath -m "${1:-$(dirname "$0")/../build-site}")
cd "$(dirname "$0")/.."
command -v mkdocs >/dev/null || { echo "build.sh: mkdocs not found; on Debian: apt-get install mkdocs mkdocs-material" >&2; exit 1; }

rm -rf "$folder/pages" "$folder/html"
mkdir -p "$folder/pages"
cp -r Docs/images "$folder/pages/"
cp Docs/mkdocs.yml "$folder/"
source=$(sed -n 's|^repo_url: ||p' Docs/mkdocs.yml)/blob/main

# Adapts the links of the pages in the top folder to the site: links to other pages become relative to the site, and
# links to other files of the project point to the repository. The second loop does the same for the pages in Docs.
for page in README CONTRIBUTING CHANGELOG; do
  sed -E -e 's#\]\(Docs/#](#g' -e 's#\]\(([A-Za-z]+/[^):]*|LICENSE|NOTICE|[a-z.]+\.sh)\)#](@\1)#g' \
    -e 's#\]\(@(images/[^)]*)\)#](\1)#g' -e "s#\]\(@#]($source/#g" "$page.md" >"$folder/pages/$page.md"
done
mv "$folder/pages/README.md" "$folder/pages/index.md"
for page in Docs/*.md; do
  sed -E -e 's#\]\(\.\./README\.md#](index.md#g' -e 's#\]\(\.\./((CONTRIBUTING|CHANGELOG)\.md)#](\1#g' \
    -e "s#\]\(\.\./#]($source/#g" "$page" >"$folder/pages/${page##*/}"
done
python3 Docs/options.py . >"$folder/pages/Options.md"
mkdocs build --quiet --strict --config-file "$folder/mkdocs.yml"
