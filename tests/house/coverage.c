/* Linked into the program of a build that counts what is executed, in the place of raise (Makefile: COUNTING): a test
 * ends some programs by a signal, whose handler raises it again, and what they did until then counts as well. */
#include <signal.h>

void __gcov_dump(void);
int __real_raise(int number);
int __wrap_raise(int number);

int __wrap_raise(int number)
{
    __gcov_dump();
    return __real_raise(number);
}
