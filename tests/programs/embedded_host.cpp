// SPDX-License-Identifier: Apache-2.0
// embedded_host LIBRARY [leave]: a program without Qt that loads embedded_plant, uses it and
// unloads it, again and again. With "leave" it ends while a plant is open.
#include <clocale>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <dirent.h>
#include <dlfcn.h>

namespace {

int failures = 0;

void check(bool isTrue, const char *what)
{
    if (isTrue)
        return;
    std::fprintf(stderr, "failed: %s\n", what);
    ++failures;
}

int threads()
{
    int count = 0;
    DIR *folder = opendir("/proc/self/task");
    while (const dirent *entry = readdir(folder))
        count += entry->d_name[0] != '.';
    closedir(folder);
    return count;
}

struct Library
{
    void *(*open)();
    int (*step)(void *, double, double *);
    void (*close)(void *);
};

template<typename Function>
void find(void *library, const char *name, Function *function)
{
    void *symbol = dlsym(library, name);
    std::memcpy(function, &symbol, sizeof symbol);
}

void use(const Library &library)
{
    void *first = library.open();
    void *second = library.open();
    check(first && second, "two plants at once");
    if (!first || !second)
        return;
    double sum = 0.0;
    for (int i = 0; i < 100; ++i)
        check(library.step(first, 1.0, &sum) == 0, "a step is complete");
    check(sum == 100.0, "100 steps add up");
    check(library.step(second, 3.0, &sum) == 0 && sum == 3.0, "the second plant has a clock of its own");
    library.close(first);
    check(library.step(second, 4.0, &sum) == 0 && sum == 7.0, "the second plant goes on without the first");
    library.close(second);
}

}  // namespace

int main(int argc, char **argv)
{
    if (argc < 2)
        return 2;
    std::signal(SIGINT, SIG_IGN);
    for (int round = 0; round < 3; ++round) {
        void *handle = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
        if (!handle) {
            std::fprintf(stderr, "%s\n", dlerror());
            return 2;
        }
        Library library{};
        find(handle, "plant_open", &library.open);
        find(handle, "plant_step", &library.step);
        find(handle, "plant_close", &library.close);
        for (int i = 0; i < 3; ++i) {
            use(library);
            check(threads() == 1, "no thread is left");
        }
        if (argc > 2) {
            check(library.open(), "a plant is open at the end");
            return failures;
        }
        dlclose(handle);
    }
    check(std::strcmp(std::setlocale(LC_ALL, nullptr), "C") == 0, "the locale is that of the program");
    check(std::signal(SIGINT, SIG_DFL) == SIG_IGN, "the signal handlers are those of the program");
    return failures;
}
