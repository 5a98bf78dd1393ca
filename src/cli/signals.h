/* What the program does when a signal ends it: signals.c; where there are none, start_wasi.c. */
#ifndef LOM_CLI_SIGNALS_H
#define LOM_CLI_SIGNALS_H

/* From here on a signal that ends the program removes the temporary files of what is being written first; a reader of
 * standard output that went away is an error of writing. Signals that the caller had ignored (nohup) stay so. */
void lom_handle_signals(void);

#endif
