// The second stage of the boot: the ROM of an RP2040 takes the first 256 bytes
// of the flash, copies them to RAM, and runs them if their last word is the
// CRC-32 of the others (image.py puts it there). The flash can be read from
// then on, by the command 03h, which every flash chip has. This code copies the
// program to RAM and starts it: from flash a step would take as long as its
// cache misses make it.
//
// It runs where the ROM has put it, so it reaches its constants by their
// distance.
void pico_boot(void);

__attribute__((naked, used, section(".boot"))) void pico_boot(void) {
  __asm__ volatile(
      ".syntax unified\n\t"
      "ldr r3, ssi\n\t"
      "movs r0, #0\n\t"
      "str r0, [r3, #0x08]\n\t" // SSIENR: off, or it takes no settings
      "movs r1, #4\n\t"
      "str r1, [r3, #0x14]\n\t" // BAUDR: a quarter of the system's clock
      "ldr r1, frame\n\t"
      "str r1, [r3, #0x00]\n\t" // CTRLR0
      "str r0, [r3, #0x04]\n\t" // CTRLR1: one frame a read
      "ldr r1, command\n\t"
      "movs r2, #0xF4\n\t"
      "str r1, [r3, r2]\n\t" // SPI_CTRLR0
      "movs r0, #1\n\t"
      "str r0, [r3, #0x08]\n\t"
      "ldr r0, flash\n\t"
      "ldr r1, ram\n\t"
      "ldr r2, bytes\n"
      "copy:\n\t"
      "ldmia r0!, {r4}\n\t"
      "stmia r1!, {r4}\n\t"
      "subs r2, #4\n\t"
      "bhi copy\n\t"
      "ldr r1, ram\n\t"
      "ldr r0, vtor\n\t"
      "str r1, [r0]\n\t"
      "ldmia r1!, {r0, r2}\n\t" // stack and entry, the first two vectors
      "msr msp, r0\n\t"
      "bx r2\n\t"
      ".balign 4\n"
      "ssi: .word 0x18000000\n"
      "frame: .word 31 << 16 | 3 << 8\n" // 32 bits; command, then data
      "command: .word 3 << 24 | 2 << 8 | 6 << 2\n" // 03h: 8 bits; address: 24
      "flash: .word 0x10000100\n"
      "ram: .word 0x20000000\n"
      "vtor: .word 0xE000ED08\n"
      "bytes: .word pico_bytes");
}
