"""The frames of a stream, as docs/PROTOCOL.md has them."""
import struct
import zlib


def decode(piece):
    """The bytes between two zeros as (type, sequence, tick, payload), or None
    where they are no frame."""
    stuffed, tail = piece[:-5], piece[-5:]
    crc = zlib.crc32(stuffed)
    if not 21 <= len(piece) <= 259 or \
            tail != bytes(128 | crc >> 7 * i & 127 for i in range(5)):
        return None
    body, at = b"", 0
    while at < len(stuffed):
        end = at + stuffed[at]
        if not at < end <= len(stuffed):
            return None
        body += stuffed[at + 1:end] + b"\0"
        at = end
    body = body[:-1]  # the last zero is the end
    version, kind, length, sequence, tick = struct.unpack_from("<BBBIQ", body)
    if version != 5 or length != len(body) - 15:
        return None
    return kind, sequence, tick, body[15:]


def frames(stream):
    """The frames among bytes from a line. What follows the last zero has not
    come whole yet."""
    found = map(decode, stream.split(b"\0")[:-1])
    return [frame for frame in found if frame is not None]


def runs(found):
    """The hashes of the run in the schemas and heartbeats among frames. Where
    there are two, the frames are of two runs."""
    return {struct.unpack_from("<I", payload, 25 if kind == 1 else 80)[0]
            for kind, _, _, payload in found if kind in (1, 6)}


def breaks(stream):
    """The ticks of the heartbeats among bytes that have another chain than that
    of the frames before them, none of which is missing: there are two runs."""
    found, chain, follows = [], None, None
    for piece in stream.split(b"\0")[:-1]:
        if (frame := decode(piece)) is None:
            continue
        kind, number, tick, payload = frame
        if number != follows:
            chain = None if number else 0
        if kind == 6:
            told, = struct.unpack_from("<I", payload, 84)
            found += [tick] if chain not in (None, told) else []
            chain = told
        if chain is not None:
            chain = zlib.crc32(piece[-5:], chain)
        follows = (number + 1) % 2**32
    return found


WORD = 2**64 - 1


def rotated(word, by):
    return (word << by | word >> 64 - by) & WORD


def siphash(key, message):
    """SipHash-2-4, as its authors write it."""
    k0, k1 = struct.unpack("<QQ", key)
    v = [k0 ^ 0x736f6d6570736575, k1 ^ 0x646f72616e646f6d,
         k0 ^ 0x6c7967656e657261, k1 ^ 0x7465646279746573]

    def rounds(count):
        for _ in range(count):
            for a, b, c, d, left, right in ((0, 1, 2, 3, 13, 16),
                                            (2, 1, 0, 3, 17, 21)):
                v[a] = v[a] + v[b] & WORD
                v[c] = v[c] + v[d] & WORD
                v[b] = rotated(v[b], left) ^ v[a]
                v[d] = rotated(v[d], right) ^ v[c]
                v[a] = rotated(v[a], 32)

    whole = message + bytes(7 - len(message) % 8) + bytes([len(message) % 256])
    for word, in struct.iter_unpack("<Q", whole):
        v[3] ^= word
        rounds(2)
        v[0] ^= word
    v[2] ^= 0xff
    rounds(4)
    return v[0] ^ v[1] ^ v[2] ^ v[3]
