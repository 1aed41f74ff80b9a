# Loops in real time on this machine. Included by the Makefile.
#
#   SECONDS=10   of each loop

$(BUILD)/double/tools/bench/realtime/empty_loop: %: %.o \
    $(addprefix $(BUILD)/double/tools/cli/,host/host.o host/lateness.o \
      host/output.o host/destination.o text/message.o)
	$(link)

# The firmware's loop on the host without a step. STEPS of it go by SECONDS, so
# it is made anew each time.
EMPTY_FIRMWARE := port/main.c port/loop.c port/host/board.c \
  tools/bench/realtime/empty_app.c

.PHONY: realtime keep-realtime
HELPERS += keep-realtime
realtime: ## lateness at 1 and 10 kHz, as histograms (matplotlib)
realtime: $(BUILD)/double/tools/bench/realtime/empty_loop $(BUILD)/double/twofold
	@for rate in 1000 10000; do \
	  MAKEFLAGS= $(MAKE) -s --no-print-directory firmware BOARD=host \
	  REAL=double SCHEME=moreau RATE=$$rate NAMED=-$$rate FORMAT=csv \
	  STEPS=$$(($(or $(SECONDS),10) * rate)) && \
	  $(CC) -std=c99 -O2 $(WARN) -Iport -DRATE=$$rate \
	  -DSTEPS=$$(($(or $(SECONDS),10) * rate)) $(EMPTY_FIRMWARE) \
	  -o $(BUILD)/double/tools/bench/realtime/empty_firmware-$$rate || exit 1; done
	$(call of_this_core,$(BUILD)/REALTIME.md,tools/bench/realtime/realtime.py \
	  '$(BUILD)' $(or $(SECONDS),10))

keep-realtime:
	cp $(BUILD)/REALTIME.md docs/
	cp $(BUILD)/realtime/lateness.svg docs/report/
