"""Effects of manufacturing tolerances: spread of results, yield, share of each tolerance, and which tolerance is worth its money.

`plan` reads tolerance files, `study` draws and runs, `figures` evaluates alternatives, `report` shows results."""
