"""The frames of a stream, as docs/PROTOCOL.md has them."""
import struct
import zlib

SCHEMA, LAYOUT, STATE, REPORT, HEARTBEAT, ANSWER, EXPIRED = 1, 2, 3, 4, 6, 8, 9
INPUT, PARAMETER, START, STOP, RESET = 0x41, 0x42, 0x44, 0x45, 0x46
DESCRIBE, DEADMAN, EVERY, SETPOINT = 0x4A, 0x4B, 0x4C, 0x4D
PARAMETERS = ("m d beta k2 c1 c2 r0 omega0 mu kappa gamma epsilon k delta "
              "sigma rho a theta dt rate tolerance segments").split()


def sealed(stuffed):
    """With its CRC."""
    crc = zlib.crc32(stuffed)
    return stuffed + bytes(128 | crc >> 7 * i & 127 for i in range(5))


def decode(piece):
    """The bytes between two zeros as (type, sequence, tick, payload), or None
    where they are no frame."""
    stuffed = piece[:-5]
    if not 21 <= len(piece) <= 259 or piece != sealed(stuffed):
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


def stuffed(body):
    """Its COBS; no 254 bytes of it are without a zero."""
    return b"".join(bytes([len(part) + 1]) + part
                    for part in body.split(b"\0"))


def framed(kind, number, tick, payload):
    """The bytes of a frame on the line."""
    body = struct.pack("<BBBIQ", 5, kind, len(payload), number, tick) + payload
    return b"\0" + sealed(stuffed(body)) + b"\0"


def frames(stream):
    """The frames among bytes from a line. What follows the last zero has not
    come whole yet."""
    found = map(decode, stream.split(b"\0")[:-1])
    return [frame for frame in found if frame is not None]


def runs(found):
    """The hashes of the run in the schemas and heartbeats among frames. Where
    there are two, the frames are of two runs."""
    return {struct.unpack_from("<I", payload, 25 if kind == SCHEMA else 80)[0]
            for kind, _, _, payload in found if kind in (SCHEMA, HEARTBEAT)}


class Line:
    """Follows the frames of a line: lost counts those that are missing; back,
    how often their numbers went back."""

    def __init__(self):
        self.lost, self.back, self.next, self.chain = 0, 0, None, None

    def breaks(self, piece, frame):
        """Takes the next frame, and the bytes that it had. Returns: whether it
        is a heartbeat with another chain than that of the frames before it,
        none of which is missing."""
        kind, number, _, payload = frame
        if number != self.next:
            gap = 0 if self.next is None else (number - self.next) % 2**32
            self.lost += gap if gap < 2**31 else 0
            self.back += gap >= 2**31
            self.chain = None if number else 0
        chain = self.chain
        if kind == HEARTBEAT:
            self.chain, = struct.unpack_from("<I", payload, 84)
        broken = chain not in (None, self.chain)
        if self.chain is not None:
            self.chain = zlib.crc32(piece[-5:], self.chain)
        self.next = (number + 1) % 2**32
        return broken


def breaks(stream):
    """The ticks of the heartbeats among bytes that have another chain: there
    are two runs."""
    line = Line()
    found = ((piece, decode(piece)) for piece in stream.split(b"\0")[:-1])
    return [frame[2] for piece, frame in found
            if frame and line.breaks(piece, frame)]


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


def tagged(key, kind, number, tick, payload, nonce=b""):
    """A payload with the tag of a key behind it."""
    body = struct.pack("<BBBIQ", 5, kind, len(payload) + 8, number, tick)
    return payload + struct.pack("<Q", siphash(key, body + payload + nonce))
