// Points of a run: growing columns of numbers, interpolated linearly at any time.

export class Record {
  constructor(names) {
    this.names = names;
    this.place = new Map(names.map((name, i) => [name, i + 1]));
    this.count = 0;
    this.columns = Array.from({ length: names.length + 1 }, () => new Float64Array(1024));
  }

  // `points`: consecutive rows of time and values.
  append(points) {
    const width = this.columns.length;
    const rows = points.length / width;
    if (this.count + rows > this.columns[0].length) {
      const room = 2 * (this.count + rows);
      this.columns = this.columns.map((column) => {
        const wider = new Float64Array(room);
        wider.set(column.subarray(0, this.count));
        return wider;
      });
    }
    for (let row = 0; row < rows; row += 1) {
      for (let k = 0; k < width; k += 1) this.columns[k][this.count + row] = points[row * width + k];
    }
    this.count += rows;
  }

  get times() {
    return this.columns[0].subarray(0, this.count);
  }

  get end() {
    return this.count === 0 ? 0 : this.columns[0][this.count - 1];
  }

  has(name) {
    return this.place.has(name);
  }

  column(name) {
    return this.columns[this.place.get(name)].subarray(0, this.count);
  }

  // Sets the time for `value(name)`.
  seek(time) {
    const times = this.columns[0];
    let low = 0;
    let high = Math.max(this.count - 1, 0);
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (times[middle] <= time) low = middle;
      else high = middle;
    }
    const width = times[high] - times[low];
    this.low = low;
    this.high = high;
    this.share = width > 0 ? Math.min(Math.max((time - times[low]) / width, 0), 1) : 0;
  }

  value(name) {
    const place = this.place.get(name);
    if (place === undefined || this.count === 0) return 0;
    const column = this.columns[place];
    return column[this.low] + this.share * (column[this.high] - column[this.low]);
  }

  // Value at the last point before the time, for quantities that must not be interpolated.
  point(name) {
    const place = this.place.get(name);
    return place === undefined || this.count === 0 ? 0 : this.columns[place][this.share < 1 ? this.low : this.high];
  }

  // Rate of change between the points around the time [1/s].
  rate(name) {
    const place = this.place.get(name);
    const width = this.columns[0][this.high] - this.columns[0][this.low];
    return place === undefined || !(width > 0) ? 0 : (this.columns[place][this.high] - this.columns[place][this.low]) / width;
  }

  // Largest magnitude of a column so far.
  largest(name) {
    return this.has(name) ? this.column(name).reduce((most, value) => Math.max(most, Math.abs(value)), 0) : 0;
  }
}
