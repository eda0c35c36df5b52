/* SPDX-License-Identifier: Apache-2.0
 * Draws the spans of drawing.h, and prints every pixel as it comes: tag and data in hexadecimal; at last "done".
 */
#include "csr.h"
#include "drawing.h" /* words, WORDS, spans, SPANS */
#include "shade.h"

#define AT(address) (*(volatile uint32_t *)(address))

static unsigned printed;

static void say(char letter) {
    while (AT(UART_TXFULL)) { }
    AT(UART_RXTX) = (uint32_t)letter;
}

static void say_text(const char *text) {
    while (*text) say(*text++);
}

static void say_hex(uint32_t value, int digits) {
    while (digits--) say("0123456789abcdef"[value >> 4 * digits & 15]);
}

static void print_pixels(void) {
    for (; AT(DOOR_VALID); AT(DOOR_PIXEL) = 0, printed++) {
        say_hex(AT(DOOR_TAG), 4);
        say(' ');
        say_hex(AT(DOOR_PIXEL), 8);
        say('\n');
    }
}

int main(void) {
    volatile uint32_t *shade = (volatile uint32_t *)SHADE_BASE;
    uint32_t beat[SHADE_SPAN_WORDS];

    if (shade_probe(shade)) say_text("no shade_core\n");
    shade_clear(shade);
    if (shade_write(shade, words, WORDS)) say_text("busy\n");
    for (int i = 0; i < SPANS; i++) {
        shade_pack(&spans[i], beat);
        for (int j = 0; j < SHADE_SPAN_WORDS; j++) {
            while (!AT(DOOR_READY)) print_pixels();
            AT(DOOR_WORD) = beat[j];
        }
    }
    while (shade_busy(shade)) print_pixels();
    print_pixels();
    say_text(shade_count(shade).pixels == printed ? "done\n" : "pixels lost\ndone\n");
    for (;;) { }
}

__attribute__((naked, used, section(".start"))) void _start(void) {
    __asm__ volatile("mv sp, %0\n j main" : : "r"(RAM_BASE + RAM_SIZE));
}
