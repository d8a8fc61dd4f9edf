// Contact pattern of a flank: the largest pressure so far at each position. Positions are rows from root to tip and
// columns from toe to heel. A contact line is one row, because all contact lines run to the apex.

export const ROWS = 96;
export const COLUMNS = 33;

// Pressure at a fraction of the distance from toe to heel, interpolated linearly between the three values of the
// library.
export function along([toe, middle, heel], share) {
  return share < 0.5 ? toe + 2 * share * (middle - toe) : middle + (2 * share - 1) * (heel - middle);
}

export class Pattern {
  // Heights of root and tip over the pitch circle at the mean cone distance [m].
  constructor(root, tip) {
    Object.assign(this, { root, tip, most: 0, largest: new Float64Array(ROWS * COLUMNS), before: [] });
  }

  // Adds the pairs of the next point. Positions that a contact line passed since the last point count, too.
  add(pairs) {
    for (const pair of pairs) {
      const last = this.before.find(({ tooth }) => tooth === pair.tooth) ?? pair;
      const [from, to] = [this.row(last.height), this.row(pair.height)];
      const steps = Math.abs(to - from);
      for (let k = 0; k <= steps; k += 1) {
        const share = steps > 0 ? k / steps : 1;
        const pressures = pair.pressures.map((pressure, i) => last.pressures[i] + share * (pressure - last.pressures[i]));
        this.press(from + Math.sign(to - from) * k, pressures);
      }
    }
    this.before = pairs;
  }

  row(height) {
    const share = (height - this.root) / (this.tip - this.root);
    return Math.min(Math.max(Math.round(share * (ROWS - 1)), 0), ROWS - 1);
  }

  press(row, pressures) {
    for (let column = 0; column < COLUMNS; column += 1) {
      const pressure = along(pressures, column / (COLUMNS - 1));
      const place = row * COLUMNS + column;
      this.largest[place] = Math.max(this.largest[place], pressure);
      this.most = Math.max(this.most, pressure);
    }
  }
}
