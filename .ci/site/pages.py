"""Pages of the site that nobody writes: the README as its start, API, commands, schema, sources that are linked."""

from __future__ import annotations

import re
from pathlib import Path
from posixpath import normpath, relpath

from api import ROOT, modules, parts
from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page
from reference import commands, defaults, words

LINK = re.compile(r"(\]\()(?!https?:|#)([^)#\s]+)")
MARK = re.compile(r"^<!-- generated: (\w+) -->$", re.MULTILINE)
DEEPER = "options: {heading_level: 3}"  # of a part of a package
LANGUAGES = {".py": "python", ".toml": "toml", ".yaml": "yaml", ".yml": "yaml", ".md": "markdown"}


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """Add a page for each public module to what can be navigated."""
    assert config.nav is not None
    config.nav.append({"API": [{module: f"api/{module}.md"} for module in modules()]})
    return config


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the pages."""

    def add(path: str, text: str) -> None:
        files.append(File.generated(config, path, content=text))

    add("index.md", (ROOT / "README.md").read_text(encoding="utf-8"))
    add("commands.md", commands())
    add("schema.md", words())
    for module in modules():
        path = f"{module.replace('.', '/')}.py"
        path = path if (ROOT / path).is_file() else path.replace(".py", "/__init__.py")
        further = "".join(f"\n## {part.rpartition('.')[2]}\n\n::: {part}\n    {DEEPER}\n" for part in parts(module))
        add(f"api/{module}.md", f"# {module}\n\n[Source](../../{path})\n\n::: {module}\n{further}")
    for path in sorted({path for file in list(files) if file.is_documentation_page() for path in linked(file)}):
        text = (ROOT / path).read_text(encoding="utf-8")
        fence = LANGUAGES.get(Path(path).suffix, "text")
        add(f"source/{path}.md", f"---\nsearch: {{exclude: true}}\n---\n# {path}\n\n~~~~{fence}\n{text}~~~~\n")
    return files


def on_page_markdown(markdown: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Lead links into the repository to the pages of the site that stand for them, and fill in what is generated."""
    if page.file.src_uri.startswith("source/"):
        return markdown
    made = LINK.sub(lambda found: found[1] + led(page.file.src_uri, found[2]), markdown)
    return MARK.sub(lambda found: {"defaults": defaults}[found[1]](), made)


def linked(file: File) -> list[str]:
    """Return the files of the repository, outside of docs/, that a page links."""
    paths = (repository_path(file.src_uri, found[2]) for found in LINK.finditer(file.content_string))
    return [path for path in paths if not path.startswith("docs/") and path != "README.md" and (ROOT / path).is_file()]


def repository_path(page: str, link: str) -> str:
    """Return where a link of a page leads, from the root of the repository."""
    return normpath(link if page == "index.md" else f"{Path('docs', page).parent.as_posix()}/{link}")


def led(page: str, link: str) -> str:
    """Return the same link within the site."""
    path = repository_path(page, link)
    if path == "README.md":
        target = "index.md"
    elif path.startswith("docs/"):
        target = path.removeprefix("docs/")
    elif (ROOT / path).is_file():
        target = f"source/{path}.md"
    else:
        return link  # which mkdocs tells of
    return relpath(target, Path(page).parent.as_posix())
