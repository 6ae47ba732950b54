"""A verb of the program in a process of its own: `python -m impactlaw._verb WORDS` prints how it came out as JSON."""

import json
import signal
import sys
import warnings

from ._impactlaw import Error, verb


def main() -> None:
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    met, error, report = True, "", ""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        try:
            met = verb(["impactlaw", *sys.argv[1:]])
        except Error as why:
            error, report = str(why), getattr(why, "report", "")
    texts = [str(one.message) for one in said]
    json.dump({"met": met, "error": error, "report": report, "warnings": texts}, sys.stdout)


if __name__ == "__main__":
    main()
