"""Puts tables and pictures into Docs/Evidence.md, each table between the page's two marks of its name."""
import json
import os

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PAGE = os.path.join(ROOT, "Docs", "Evidence.md")
IMAGES = os.path.join(ROOT, "Docs", "images")


def table(header, rows):
    lines = [header, ["---"] + ["---:"] * (len(header) - 1), *rows]
    return "".join("| " + " | ".join(map(str, line)) + " |\n" for line in lines)


def with_tables(text, tables):
    """Returns the page's text with each table between its marks. Raises ValueError if the page lacks these marks."""
    for name, content in tables.items():
        begin, end = f"<!-- {name} -->\n", f"<!-- end of {name} -->\n"
        start = text.index(begin) + len(begin)
        text = text[:start] + content + text[text.index(end, start):]
    return text


def put(tables):
    with open(PAGE, encoding="utf-8") as file:
        text = with_tables(file.read(), tables)
    with open(PAGE, "w", encoding="utf-8") as file:
        file.write(text)


def leave(records, tables, path, is_for_page):
    """Writes the records to `path`.json and the tables to `path`.md, prints the tables and, if `is_for_page`, puts them
    into the page."""
    text = "\n".join(tables.values())
    with open(f"{path}.json", "w", encoding="utf-8") as file:
        json.dump(records, file, indent=1)
    with open(f"{path}.md", "w", encoding="utf-8") as file:
        file.write(text)
    if is_for_page:
        put(tables)
    print(text)
