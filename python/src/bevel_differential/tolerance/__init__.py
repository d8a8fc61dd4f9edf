"""What manufacturing tolerances do: spread of figures, yield, the part of each tolerance, and which is worth its money.

`plan` reads tolerance files, `study` draws and runs, `figures` judges alternatives, `report` shows results."""
