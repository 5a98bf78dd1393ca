/* The program. In: the command line. Out: the exit status of the subcommand it names, or 2 when standard output could
 * not take all that was printed. Invariant: status 0 means that everything asked for has been delivered. */
#include "commands.h"
#include "options.h"
#include "signals.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

typedef struct command {
    const char *name, *summary;
    int (*run)(int argc, char **argv);
} command;

static const command commands[] = {
    { "compare", "say whether and how much two pictures differ", lom_command_compare },
    { "info", "say what is in an image, a mesh or a scene", lom_command_info },
    { "convert", "write an image or a mesh in another form", lom_command_convert },
    { "make", "make an asset: height map, normal map, sky box, texture, entity", lom_command_make },
    { "plan", "say which passes a scene needs, why, and what was left out", lom_command_plan },
    { "explain", "say what made a pixel: every triangle that touched it, and why", lom_command_explain },
    { "overlay", "show what the stages did at each pixel: overdraw, mip levels, steps of rays", lom_command_overlay },
    { "render", "draw a scene", lom_command_render },
    { "cost", "say how many frames of a run a core draws in an hour", lom_command_cost },
    { "join", "put the parts of a run together that several machines drew", lom_command_join },
    { "view", "show a scene in a window, fly through it, change it", lom_command_view },
    { "steps", "draw a scene stage by stage: a numbered picture each, and a page with a slider", lom_command_steps },
    { "bench", "draw workloads and say how long a frame takes", lom_command_bench },
    { "trade", "say what each dial of a scene buys: error against a reference over milliseconds", lom_command_trade },
    { "tune", "find the cheapest settings within an error, or the most exact within declared work", lom_command_tune },
    { "lesson", "list the lessons, draw one, check the answer to an exercise", lom_command_lesson },
    { "grade", "compare a student's stage of the pipeline with the right one, name the broken rule",
      lom_command_grade },
    { "selftest", "draw built-in content: one hash, the same on every machine", lom_command_selftest },
    { "verify", "draw golden pictures of a project, compare them with their hashes, approve them", lom_command_verify },
    { "approve", "write the hashes of approved pictures into the manifest of lom verify", lom_command_approve },
    { "version", "say which lom this is and what the machine offers", lom_command_version },
};
enum { COMMAND_COUNT = sizeof commands / sizeof commands[0] };

static const command *find_command(const char *name)
{
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        if (strcmp(commands[i].name, name) == 0)
            return &commands[i];
    return NULL;
}

static void print_overview(FILE *out)
{
    fprintf(out,
            "lom %s: draws scenes on the CPU, to the same bytes on every machine.\n\n"
            "usage: lom COMMAND [ARGUMENT]...\n\ncommands:\n",
            LOM_VERSION);
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        fprintf(out, "  %-10s %s\n", commands[i].name, commands[i].summary);
    fprintf(out,
            "\n`lom help COMMAND` or `lom COMMAND --help` explains one. \"-\" as a file is standard input or output.\n"
            "Exit status: 0 done or accepted, 1 differs or a check failed, 2 could not do it.\n");
}

static int unknown_command(const char *name)
{
    const char *names[COMMAND_COUNT];
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        names[i] = commands[i].name;
    const char *near = lom_nearest_name(name, strlen(name), names, COMMAND_COUNT);
    if (near != NULL)
        return lom_complain("unknown command \"%s\" (did you mean \"%s\"?)", name, near);
    return lom_complain("unknown command \"%s\"; `lom --help` lists them.", name);
}

static int help(const char *name)
{
    const command *found = find_command(name);
    char help_option[] = "--help";
    if (found == NULL)
        return unknown_command(name);
    char *argv[] = { (char *)(uintptr_t)found->name, help_option, NULL };
    return found->run(2, argv);
}

static int run(int argc, char **argv)
{
    if (argc < 2) {
        print_overview(stderr);
        return LOM_EXIT_FAILED;
    }
    const char *name = argv[1];
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0 || (strcmp(name, "help") == 0 && argc == 2)) {
        print_overview(stdout);
        return LOM_EXIT_DONE;
    }
    if (strcmp(name, "help") == 0)
        return argc == 3 ? help(argv[2]) : lom_complain("help takes the name of one command.");
    if (strcmp(name, "--version") == 0)
        name = "version";
    const command *found = find_command(name);
    return found != NULL ? found->run(argc - 1, argv + 1) : unknown_command(name);
}

/* A standard stream that the caller closed would give its number to the next file that is opened, and messages would
 * land in a picture. So such a number is taken by a descriptor that fails as a closed one does. */
static void occupy_standard_streams(void)
{
    for (int stream = 0; stream <= 2; stream++)
        if (fcntl(stream, F_GETFD) == -1 && errno == EBADF)
            (void)!open("/dev/null", stream == 0 ? O_WRONLY : O_RDONLY);
}

int main(int argc, char **argv)
{
    occupy_standard_streams();
    lom_handle_signals();
    int status = run(argc, argv);
    errno = 0;
    if (fflush(stdout) != 0 || ferror(stdout) || close(STDOUT_FILENO) != 0)
        status = lom_complain("standard output: %s.", errno != 0 ? strerror(errno) : "not everything was taken");
    return status;
}
