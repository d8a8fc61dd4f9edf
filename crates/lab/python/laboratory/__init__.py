"""The program of the laboratory, with Python's standard library only.

- `measuring`, `checking`, `everything`: the commands
- `page_tests`, `memcheck`, `platform_units`: the longer ones of them
- `command`: declaration of a command; `work`: its run, with the Python environment of its script, and the renewal of documents
- `terminal`, `documents`, `paths`: progress, tables and errors; sections of documents; folders and programs"""
