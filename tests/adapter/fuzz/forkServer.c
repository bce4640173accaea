// SPDX-License-Identifier: GPL-3.0-or-later

// A library to be preloaded: instead of running once, the program runs its main in a child
// for each line that it reads, "SECONDS<tab>FOLDER<tab>LOG<tab>ARGUMENT..." (the first
// argument is the program's name), and answers each by a line with the status of wait().
// Libraries are loaded once, so that a run costs milliseconds. FORK_MEMORY limits the
// memory of each child, in MiB.

#define _GNU_SOURCE

#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

typedef int (*Main)(int, char**, char**);

static Main programMain;

static void limitMemory(void)
{
    const char* megabytes = getenv("FORK_MEMORY");
    if (megabytes)
    {
        const rlim_t bytes = (rlim_t)atol(megabytes) << 20;
        const struct rlimit limit = {bytes, bytes};
        setrlimit(RLIMIT_AS, &limit);
    }
    const struct rlimit none = {0, 0};
    setrlimit(RLIMIT_CORE, &none);
}

static void redirect(const char* log)
{
    const int in = open("/dev/null", O_RDONLY);
    const int out = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    dup2(in, STDIN_FILENO);
    dup2(out, STDOUT_FILENO);
    dup2(out, STDERR_FILENO);
}

static void run(char* line, char** environment)
{
    char* words[64];
    int n = 0;
    for (char* word = strtok(line, "\t\n"); word && n < 63; word = strtok(NULL, "\t\n"))
    {
        words[n++] = word;
    }
    words[n] = NULL;
    setpgid(0, 0);
    redirect(words[2]);
    limitMemory();
    if (n < 4 || chdir(words[1]) != 0)
    {
        _exit(125);
    }
    setenv("PWD", words[1], 1);
    alarm((unsigned)atoi(words[0]));
    exit(programMain(n - 3, words + 3, environment));
}

static int serve(int argc, char** argv, char** environment)
{
    char line[65536];
    (void)argc;
    (void)argv;
    while (fgets(line, sizeof(line), stdin))
    {
        const pid_t child = fork();
        int status = -1;
        if (child == 0)
        {
            run(line, environment);
        }
        waitpid(child, &status, 0);
        kill(-child, SIGKILL); // what it may have started
        printf("%d\n", status);
        fflush(stdout);
    }
    return 0;
}

int __libc_start_main(
    Main main, int argc, char** argv, void (*init)(void), void (*fini)(void),
    void (*ldFini)(void), void* stackEnd
)
{
    int (*start)(Main, int, char**, void (*)(void), void (*)(void), void (*)(void), void*);
    *(void**)&start = dlsym(RTLD_NEXT, "__libc_start_main");
    unsetenv("LD_PRELOAD");
    programMain = main;
    return start(serve, argc, argv, init, fini, ldFini, stackEnd);
}
