/* The subcommands of the program: each in the file of its name, each given argv from its own name on, each returning
 * an exit status (options.h). */
#ifndef LOM_CLI_COMMANDS_H
#define LOM_CLI_COMMANDS_H

int lom_command_approve(int argc, char **argv);
int lom_command_bench(int argc, char **argv);
int lom_command_compare(int argc, char **argv);
int lom_command_convert(int argc, char **argv);
int lom_command_cost(int argc, char **argv);
int lom_command_explain(int argc, char **argv);
int lom_command_grade(int argc, char **argv);
int lom_command_info(int argc, char **argv);
int lom_command_join(int argc, char **argv);
int lom_command_lesson(int argc, char **argv);
int lom_command_make(int argc, char **argv);
int lom_command_overlay(int argc, char **argv);
int lom_command_plan(int argc, char **argv);
int lom_command_render(int argc, char **argv);
int lom_command_selftest(int argc, char **argv);
int lom_command_steps(int argc, char **argv);
int lom_command_trade(int argc, char **argv);
int lom_command_tune(int argc, char **argv);
int lom_command_verify(int argc, char **argv);
int lom_command_version(int argc, char **argv);
int lom_command_view(int argc, char **argv);

#endif
