/* Signals that end the program. In: a signal. Out: no temporary file, and an end by that same signal, so that the
 * caller sees what happened. Invariant: the handler calls only what is async-signal-safe. */
#include "signals.h"

#include <lom/base.h>

#include <signal.h>
#include <stddef.h>

/* What ends a program unless it is handled, and is no fault of its own. */
static const int ends[] = { SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGALRM, SIGVTALRM, SIGPROF, SIGUSR1, SIGUSR2, SIGXCPU };

static void end(int number)
{
    sigset_t one;
    lom_remove_temporaries();
    sigemptyset(&one);
    sigaddset(&one, number);
    signal(number, SIG_DFL);
    raise(number);
    pthread_sigmask(SIG_UNBLOCK, &one, NULL); /* held back until the handler returns, unless it is let through here */
}

void lom_handle_signals(void)
{
    struct sigaction before, action = { .sa_handler = end };
    sigfillset(&action.sa_mask);
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++)
        if (sigaction(ends[i], NULL, &before) == 0 && before.sa_handler == SIG_DFL)
            sigaction(ends[i], &action, NULL);
    signal(SIGPIPE, SIG_IGN);
}
