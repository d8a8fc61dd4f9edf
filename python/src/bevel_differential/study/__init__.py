"""The two cases of the study, simulated and compared with the study and with theory."""
