// Numbers as the command line writes them, byte for byte: the fewest
// digits that read back to the same bits, laid out as %g of C.

export const MIN_NORMAL = 2 ** -1022;

// The power of ten behind the digits.
export const power = (e) => `e${e < 0 ? '-' : '+'}` +
  String(Math.abs(e)).padStart(2, '0');

// size: so many digits; without it, the fewest.
export function decimal(x, size) {
  if (x === 0) return Object.is(x, -0) ? '-0' : '0';
  if (!Number.isFinite(x)) return x > 0 ? 'inf' : x < 0 ? '-inf' : 'nan';
  const [, sign, first, rest = '', e] = x.toExponential(size && size - 1)
    .match(/^(-?)(\d)(?:\.(\d*?))?0*e([+-]\d+)$/);
  const digits = first + rest, exponent = Number(e);
  // %g takes an exponent from its precision on: that of the command line's
  // search is 15 at least, but for subnormal numbers.
  const precision = size ?? (Math.abs(x) < MIN_NORMAL ? digits.length
    : Math.max(15, digits.length));
  if (exponent < -4 || exponent >= precision)
    return sign + first + (rest && `.${rest}`) + power(exponent);
  if (exponent < 0) return `${sign}0.${'0'.repeat(-exponent - 1)}${digits}`;
  const whole = digits.slice(0, exponent + 1).padEnd(exponent + 1, '0');
  const part = digits.slice(exponent + 1);
  return sign + whole + (part && `.${part}`);
}

// A number for whoever reads it back: the reader refuses decimals that are too
// small for all of their digits to count, so those are hexadecimal.
export function exact(x) {
  if (x === 0 || Math.abs(x) >= MIN_NORMAL) return decimal(x);
  return `${x < 0 ? '-' : ''}0x${Math.abs(x / 2 ** -1074).toString(16)}p-1074`;
}

// A number for people, in so many significant digits, with a true minus.
export function short(x, digits = 4) {
  if (!Number.isFinite(x)) return String(x);
  const size = Math.abs(x);
  const text = size !== 0 && (size < 1e-3 || size >= 1e5)
    ? x.toExponential(digits - 1).replace(/\.?0*e\+?/, 'e')
    : String(Number(x.toPrecision(digits)));
  return text.replace(/-/g, '\u2212');
}
