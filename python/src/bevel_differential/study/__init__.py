"""The published study that this program replaces: its two cases, beside it and beside theory."""
