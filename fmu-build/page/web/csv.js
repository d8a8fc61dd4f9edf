// Traces as a file for a table or a script, with the columns of the command `run` in SI.

// Text of a record's columns, with a row for each point.
export function csv(record, names) {
  const columns = [record.times, ...names.map((name) => record.column(name))];
  const rows = Array.from(record.times, (_, i) => columns.map((column) => column[i]).join(","));
  return `${[["time", ...names].join(","), ...rows].join("\n")}\n`;
}

// Offers the file as a download.
export function save(file, record, names) {
  const address = URL.createObjectURL(new Blob([csv(record, names)], { type: "text/csv" }));
  Object.assign(document.createElement("a"), { href: address, download: file }).click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}
