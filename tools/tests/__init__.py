"""Tests of the `hipr` command: `python3 -m unittest discover -s tools/tests -t tools`."""
