// Amplitudes of an output over orders of the mesh: order 1 is one period per tooth, order 2 two periods.

export const HIGHEST = 8; // order
const FINEST = 4000; // maximum number of transformed points

// Returns {orders, amplitudes} of the last whole mesh cycles, or null if the record contains none. `frequency` is the
// mesh frequency [Hz]. The amplitude at order k is A in A cos(2 pi k f t), from Fourier sums over whole cycles.
export function spectrum(times, values, frequency) {
  const length = times[times.length - 1] - times[0];
  const cycles = Math.floor(length * Math.abs(frequency) + 1e-9);
  if (cycles < 1 || times.length < 8) return null;
  const span = cycles / Math.abs(frequency);
  const begin = times[times.length - 1] - span;
  const count = Math.min(times.length, FINEST);
  const points = resampled(times, values, begin, span, count);
  const mean = points.reduce((sum, value) => sum + value, 0) / count;
  const lines = Math.min(HIGHEST * cycles, Math.floor(count / 2) - 1);
  const orders = Float64Array.from({ length: lines }, (_, k) => (k + 1) / cycles);
  const amplitudes = orders.map((_, k) => {
    let [real, imaginary] = [0, 0];
    const turn = (2 * Math.PI * (k + 1)) / count;
    for (let i = 0; i < count; i += 1) {
      real += (points[i] - mean) * Math.cos(turn * i);
      imaginary += (points[i] - mean) * Math.sin(turn * i);
    }
    return (2 / count) * Math.hypot(real, imaginary);
  });
  return { orders, amplitudes };
}

// Resamples at equal time intervals, by linear interpolation.
function resampled(times, values, begin, span, count) {
  let after = 1;
  return Float64Array.from({ length: count }, (_, i) => {
    const time = begin + (span * i) / count;
    while (after < times.length - 1 && times[after] < time) after += 1;
    const width = times[after] - times[after - 1];
    const share = width > 0 ? Math.min(Math.max((time - times[after - 1]) / width, 0), 1) : 0;
    return values[after - 1] + share * (values[after] - values[after - 1]);
  });
}
