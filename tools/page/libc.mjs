// The module of the simulator, and what its C lacks of a C library: numbers from
// text and into it, which the browser reads and writes exactly.
import { MIN_NORMAL, decimal, power } from './decimal.mjs';

const ERANGE = 34; // as in libc.h
const NUMBER = new RegExp('^[+-]?(?:' +
  '(0x(?:[\\da-f]+\\.?[\\da-f]*|\\.[\\da-f]+)(?:p[+-]?\\d+)?)|' +
  '(?:\\d+\\.?\\d*|\\.\\d+)(?:e[+-]?\\d+)?|inf(?:inity)?|nan)', 'i');

// Without a sign. The power is halved, because half of it is in range where the
// number is.
function fromHex(text) {
  const [, whole, part, e = 0] =
    text.match(/^0x([\da-f]*)\.?([\da-f]*)(?:p(.*))?$/i);
  const digits = BigInt(`0x${whole}${part}`), two = Number(e) - 4 * part.length;
  const scaled = (by) => Number(digits) && Number(digits) *
    2 ** Math.floor(by / 2) * 2 ** Math.ceil(by / 2);
  return { value: scaled(two), isWhole: Number.isInteger(scaled(two + 1074)) &&
    BigInt(Number(digits)) === digits };
}

// The number at the start of a text. Returns: its length, 0 where there is
// none; its value; and whether it loses bits below the least normal number.
function number(text) {
  const [found, hex] = text.match(NUMBER) ?? [''];
  const size = found.replace(/^[+-]/, '');
  const { value, isWhole } = hex ? fromHex(hex) : {
    value: /^i/i.test(size) ? Infinity : Number(size),
    isWhole: /^[0.]*(?:e|$)/i.test(size) };
  return { length: found.length, isTiny: value < MIN_NORMAL && !isWhole,
    value: found[0] === '-' ? -value : value };
}

export function textAt({ memory }, at) {
  const bytes = new Uint8Array(memory.buffer, at);
  return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
}

// The functions of an instance without imports. Instances share nothing.
export function instantiate(module) {
  let c = null;
  const view = () => new DataView(c.memory.buffer);
  const env = {
    strtod(text, end) {
      const { length, value, isTiny } = number(textAt(c, text));
      if (end) view().setUint32(end, text + length, true);
      if (isTiny) view().setInt32(c.errno.value, ERANGE, true);
      return value;
    },
    // For the formats that the page's sources have. list: of the arguments, one
    // behind the other, each at a multiple of its size.
    print(to, room, format, list) {
      const next = (size) => {
        const at = Math.ceil(list / size) * size;
        list = at + size;
        return at;
      };
      const text = textAt(c, format).replace(/%(\.\*)?[lz]?(.)/g,
        (_, sized, kind) => {
          const size = sized ? view().getInt32(next(4), true) : 6;
          const real = () => view().getFloat64(next(8), true);
          const kinds = {
            s: () => textAt(c, view().getUint32(next(4), true)),
            u: () => view().getUint32(next(4), true),
            d: () => view().getInt32(next(4), true),
            g: () => decimal(real(), size),
            e: () => real().toExponential(size)
              .replace(/e(.*)/, (__, e) => power(e)),
          };
          return kinds[kind]();
        });
      const bytes = new TextEncoder().encode(text);
      if (room > 0)
        new Uint8Array(c.memory.buffer, to, room)
          .set([...bytes.subarray(0, room - 1), 0]);
      return bytes.length;
    },
  };
  c = new WebAssembly.Instance(module, { env }).exports;
  return c;
}
