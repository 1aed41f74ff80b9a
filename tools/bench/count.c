// A plugin for QEMU's translator that counts instructions between two markers:
//   qemu-system-... -plugin ./count.so,open=ADDRESS,close=ADDRESS,out=FILE
// At the end FILE gets for every window, as uint32_t, the instructions executed
// after the call of window_open and before that of window_close. The first
// window is empty.
//
// Debian ships no header of the plugin interface; what is used of its version 1
// is declared here. The guest must be on one processor.
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef uint64_t qemu_plugin_id_t;
typedef struct qemu_info_t qemu_info_t;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
enum qemu_plugin_cb_flags { QEMU_PLUGIN_CB_NO_REGS };
enum qemu_plugin_op { QEMU_PLUGIN_INLINE_ADD_U64 };

typedef void (*tb_callback_t)(qemu_plugin_id_t, struct qemu_plugin_tb *);
typedef void (*exec_callback_t)(unsigned, void *);
typedef void (*exit_callback_t)(qemu_plugin_id_t, void *);

void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t, tb_callback_t);
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb *);
struct qemu_plugin_insn *qemu_plugin_tb_get_insn(const struct qemu_plugin_tb *,
                                                 size_t);
uint64_t qemu_plugin_insn_vaddr(const struct qemu_plugin_insn *);
void qemu_plugin_register_vcpu_insn_exec_cb(struct qemu_plugin_insn *,
                                            exec_callback_t,
                                            enum qemu_plugin_cb_flags, void *);
void qemu_plugin_register_vcpu_insn_exec_inline(struct qemu_plugin_insn *,
                                                enum qemu_plugin_op, void *,
                                                uint64_t);
void qemu_plugin_register_atexit_cb(qemu_plugin_id_t, exit_callback_t, void *);

#define EXPORT __attribute__((visibility("default")))
extern EXPORT int qemu_plugin_version;
EXPORT int qemu_plugin_version = 1;
EXPORT int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t *info,
                               int argc, char **argv);

static uint64_t executed; // instructions so far, counted inline
static uint64_t at_open, open_address, close_address;
static FILE *out;

static void on_open(unsigned cpu, void *data) {
  (void)cpu, (void)data;
  at_open = executed;
}

static void on_close(unsigned cpu, void *data) {
  (void)cpu, (void)data;
  const uint32_t window = (uint32_t)(executed - at_open);
  fwrite(&window, sizeof window, 1, out);
}

static void on_translation(qemu_plugin_id_t id, struct qemu_plugin_tb *tb) {
  (void)id;
  for (size_t i = 0; i < qemu_plugin_tb_n_insns(tb); i++) {
    struct qemu_plugin_insn *insn = qemu_plugin_tb_get_insn(tb, i);
    const uint64_t address = qemu_plugin_insn_vaddr(insn);
    if (address == open_address)
      qemu_plugin_register_vcpu_insn_exec_cb(insn, on_open,
                                             QEMU_PLUGIN_CB_NO_REGS, NULL);
    if (address == close_address)
      qemu_plugin_register_vcpu_insn_exec_cb(insn, on_close,
                                             QEMU_PLUGIN_CB_NO_REGS, NULL);
    qemu_plugin_register_vcpu_insn_exec_inline(insn, QEMU_PLUGIN_INLINE_ADD_U64,
                                               &executed, 1);
  }
}

static void on_exit_of_qemu(qemu_plugin_id_t id, void *data) {
  (void)id, (void)data;
  fclose(out);
}

int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t *info, int argc,
                        char **argv) {
  (void)info;
  for (int i = 0; i < argc; i++) {
    if (!strncmp(argv[i], "open=", 5))
      open_address = strtoull(argv[i] + 5, NULL, 0);
    if (!strncmp(argv[i], "close=", 6))
      close_address = strtoull(argv[i] + 6, NULL, 0);
    if (!strncmp(argv[i], "out=", 4)) out = fopen(argv[i] + 4, "wb");
  }
  if (!open_address || !close_address || out == NULL) {
    fprintf(stderr, "count: open=, close= and out= are needed\n");
    return 1;
  }
  qemu_plugin_register_vcpu_tb_trans_cb(id, on_translation);
  qemu_plugin_register_atexit_cb(id, on_exit_of_qemu, NULL);
  return 0;
}
