/* What cpu.c reads from the system, apart from where it lies, so that a test can lay out another system. */
#ifndef LOM_BASE_CPU_H
#define LOM_BASE_CPU_H

#include <lom/base.h>

/* Whether gathers of 512 bits take less time than a load a lane. AMD's are microcode; so are Intel's from Skylake to Ice
 * Lake since they keep data from being sampled through them (INTEL-SA-00828), which is what the system is asked for. It
 * chooses speed alone. */
bool lom_has_fast_gathers(void);

/* The CPU quota of the control groups this process is in, in CPUs rounded up; 0 when there is none. membership is the
 * text of /proc/self/cgroup, root the folder where the hierarchies are mounted (/sys/fs/cgroup). */
int lom_cgroup_cpus(const char *membership, const char *root);

/* The same of memory, in bytes; 0 when nothing limits it. */
uint64_t lom_cgroup_memory(const char *membership, const char *root);

/* The memory that this process may use, in bytes: the machine's, or less where a control group says so; 0 when the
 * system does not tell. */
uint64_t lom_machine_memory(void);

#endif
