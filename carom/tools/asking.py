"""Asking: questions to a recording in SQL, by polars."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from carom.ecs.errors import CaromError, did_you_mean

if TYPE_CHECKING:
    from carom.tools.recording import Recording

WORDS = re.compile(r"""'[^']*'|"[^"]*"|[A-Za-z_][\w.]*""")  # texts and names in quotes are left as they are
FORM = "write it as TABLE, TABLE where CONDITION, or a SELECT"


def ask(recording: Recording, question: str) -> Any:
    """Return the answer to ``contacts where depth > 0.01``, or to a whole SELECT, as a `polars.DataFrame`.

    Raises CaromError for tables and columns that are not there, wrong syntax, and where polars is not installed.
    """
    try:
        import polars
    except ModuleNotFoundError:
        raise CaromError("query: polars is not installed; run: pip install 'carom[dataframe]'") from None

    selects = re.match(r"\s*(select|with)\b", question, re.IGNORECASE)
    statement = question if selects else f"SELECT * FROM {question}"
    words = {word.split(".")[0].strip('"') for word in WORDS.findall(statement)}
    frames = {name: recording.table(name).polars() for name in recording.tables() if name in words}
    columns = list(dict.fromkeys(name for frame in frames.values() for name in frame.columns))
    try:
        with polars.SQLContext(frames, eager=True) as context:
            return context.execute(_quoted(statement, columns))
    except polars.exceptions.PolarsError as fault:
        raise CaromError(_told(str(fault), question, recording.tables(), columns)) from None


def _quoted(statement: str, columns: list[str]) -> str:
    """Return a statement with columns such as ``a.name`` in quotes, since SQL takes a dot for that after a table."""
    dotted = [name for name in columns if "." in name]

    def quote(word: re.Match[str]) -> str:
        text = word[0]
        name = next((name for name in dotted if text == name or text.endswith(f".{name}")), None)
        return text if name is None or text[0] in "'\"" else f'{text.removesuffix(name)}"{name}"'

    return WORDS.sub(quote, statement)


def _told(fault: str, question: str, tables: list[str], columns: list[str]) -> str:
    """Return what is wrong, what was received and what is accepted."""
    for kind, known, pattern in (
        ("table", tables, r"relation '(.+?)' was not found"),
        ("column", columns, r"unable to find column \"(.+?)\""),
    ):
        if missing := re.match(pattern, fault):
            hint = did_you_mean(missing[1], known)
            accepted = f"accepted: {', '.join(known)}"
            return "; ".join(filter(None, (f"query: no {kind} '{missing[1]}'", accepted, hint)))
    reason = fault.partition("\n")[0].removeprefix("sql parser error: ")
    return f"query: {reason}; received {question!r}; {FORM}"
