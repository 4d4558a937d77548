"""Query: ask a recording for a table, or tell which it has."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from carom.tools.commands.options import ending, print_json, print_warnings

if TYPE_CHECKING:
    from carom.tools.recording import Recording

MOST_ROWS = 40  # on a terminal


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the recording, the question and where the answer goes."""
    parser.add_argument("file", type=Path, metavar="FILE", help="a recording (.rrd)")
    parser.add_argument(
        "question",
        nargs="?",
        metavar="QUESTION",
        help="such as 'contacts where depth > 0.01 and speed > 5', or a SELECT; without one the tables are told",
    )
    parser.add_argument("--csv", action="store_true", help="print all rows as CSV")
    parser.add_argument(
        "--out",
        type=ending(".parquet", ".csv", ".json"),
        metavar="FILE",
        help="write all rows (.parquet, .csv or .json) instead",
    )


def execute(arguments: argparse.Namespace) -> int:
    """Print the answer, or write it."""
    from carom.ecs.errors import CaromError
    from carom.tools.asking import ask
    from carom.tools.outputs import prepare_outputs
    from carom.tools.recording import open_recording, refuse_missing

    if arguments.question is None and (arguments.csv or arguments.out):
        raise CaromError(f"--{'csv' if arguments.csv else 'out'}: goes with a question, such as 'contacts'")
    refuse_missing(arguments.file)
    prepare_outputs([arguments.out])
    recording, notes = open_recording(arguments.file)
    print_warnings(notes)
    if arguments.question is None:
        contents(recording, arguments.json)
        return 0
    answer = ask(recording, arguments.question)
    if arguments.out:
        writers = {".parquet": answer.write_parquet, ".csv": answer.write_csv, ".json": answer.write_json}
        writers[arguments.out.suffix.lower()](arguments.out)
        print(f"{arguments.out}: {answer.height} rows")
    elif arguments.csv:
        print(answer.write_csv(), end="")
    elif arguments.json:
        print(answer.write_json())
    else:
        print(text(answer))
    return 0


def contents(recording: Recording, as_json: bool) -> None:
    """Print the tables of a recording with the columns, units and meanings, and how many rows they have."""
    tables = []
    for name in recording.tables():
        table = recording.table(name).arrow()
        about = [{key.decode(): value.decode() for key, value in field.metadata.items()} for field in table.schema]
        columns = [{"name": path, **meant} for path, meant in zip(table.column_names, about, strict=True)]
        tables.append({"table": name, "rows": table.num_rows, "columns": columns})
    if as_json:
        print_json(tables)
        return
    for table in tables:
        print(f"{table['table']}: {table['rows']} rows")
        for column in table["columns"]:
            print(f"  {column['name']:<12} {column['unit']:<6} {column['doc']}")


def text(answer: Any) -> str:
    """Return a table to read: its first and last rows where there are many, and how many there are."""
    import polars

    with polars.Config(
        tbl_formatting="NOTHING",
        tbl_hide_column_data_types=True,
        tbl_hide_dataframe_shape=True,
        tbl_rows=MOST_ROWS,
        tbl_cols=-1,
        tbl_width_chars=10_000,
        fmt_str_lengths=100,
    ):
        lines = [line.rstrip() for line in str(answer).splitlines()]
    return "\n".join([*lines, f"{answer.height} rows"])
