// Detection of rolling planets: rocking within a tooth pitch brings no new tooth into mesh.

// True if a planet of `record` was rolling between the points around the time; `half` is half a pitch [rad].
export function rolls(record, planets, half) {
  const names = Array.from({ length: planets }, (_, i) => `planet[${i + 1}].spin_angle`).filter((name) => record.has(name));
  return names.map((name) => record.column(name)).some((angles) => {
    let place = 0;
    let isRolling = false;
    for (let k = 1; k <= record.high; k += 1) {
      const wanted = place + angles[k] - angles[k - 1];
      place = Math.min(Math.max(wanted, -half), half);
      isRolling = wanted !== place;
    }
    return isRolling;
  });
}
