/* Does one process alone make an item, is one that was killed at it followed by another, and does nothing
 * stay beside the outputs? */
#define _GNU_SOURCE
#include "frame_claim.h"

#include "atomic_file.h"
#include "file_cases.h"
#include "whole_file.h"

#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

static char folder[512];

static int make_folder(void **state)
{
    (void)state;
    scratch_path(folder, sizeof folder, "claim-XXXXXX");
    assert_non_null(mkdtemp(folder));
    return chdir(folder);
}

static int remove_folder(void **state)
{
    (void)state;
    const int left = count_names(".");
    if (left > 0)
        print_error("%d names left in %s\n", left, folder);
    return left | chdir("/") | rmdir(folder);
}

static bool is_there(const char *path)
{
    return access(path, F_OK) == 0;
}

/* The item that racers are at: two outputs of a number, which is what they hold. */
typedef struct item {
    char names[2][32];
    char *outputs[2];
} item;

static void name_item(item *it, int number)
{
    snprintf(it->names[0], sizeof it->names[0], "first.%04d", number);
    snprintf(it->names[1], sizeof it->names[1], "second.%04d", number);
    it->outputs[0] = it->names[0];
    it->outputs[1] = it->names[1];
}

static bool is_made(const item *it)
{
    return is_there(it->outputs[0]) && is_there(it->outputs[1]);
}

/* Makes an item that is not made, if no other is at it; says so in `log`, which lines are added to whole.
 * Returns whether it is made now. */
static bool make_item(int number, int log)
{
    item it;
    tl_frame_claim *claim = NULL;
    char text[32];
    name_item(&it, number);
    if (is_made(&it))
        return true;
    if (tl_frame_claim_take(it.outputs, 2, &claim, NULL) != TL_OK)
        _exit(3);
    if (!claim)
        return false;
    if (!is_made(&it)) {
        const int length = snprintf(text, sizeof text, "%d\n", number);
        if (write(log, text, (size_t)length) != length ||
            tl_whole_file_write(it.outputs[number % 2], text, (size_t)length, NULL) != TL_OK ||
            tl_whole_file_write(it.outputs[1 - number % 2], text, (size_t)length, NULL) !=
                TL_OK)
            _exit(4);
    }
    tl_frame_claim_end(claim);
    return true;
}

enum { ITEMS = 200, ITEMS_OF_THREADS = 40, RACERS = 3 };

/* Round after round, until all is made. */
static _Noreturn void race(void)
{
    const int log = open("log", O_WRONLY | O_APPEND | O_CREAT, 0666);
    int left = log >= 0 ? ITEMS : 0;
    for (int round = 0; left > 0; round++) {
        left = 0;
        for (int i = 0; i < ITEMS; i++)
            left += !make_item(i, log);
        if (round > 100000)
            _exit(2);
    }
    _exit(0);
}

/* Every item was made once, is there, and nothing else; then none is. */
static void check_race(int count)
{
    int made[ITEMS] = {0}, number;
    char text[32];
    FILE *log = fopen("log", "r");
    assert_non_null(log);
    while (fscanf(log, "%d", &number) == 1)
        made[number]++;
    fclose(log);
    for (int i = 0; i < count; i++) {
        item it;
        name_item(&it, i);
        if (made[i] != 1)
            fail_msg("item %d was made %d times", i, made[i]);
        snprintf(text, sizeof text, "%d\n", i);
        for (int k = 0; k < 2; k++) {
            assert_holds(it.outputs[k], text);
            remove(it.outputs[k]);
        }
    }
    assert_int_equal(count_names("."), 1);
    remove("log");
}

static void each_is_made_once(void **state)
{
    int status;
    (void)state;
    for (int i = 0; i < RACERS; i++)
        if (fork() == 0)
            race();
    for (int i = 0; i < RACERS; i++) {
        assert_true(wait(&status) > 0);
        assert_int_equal(status, 0);
    }
    check_race(ITEMS);
}

/* The same with threads, each of which goes through all. */
static int thread_log;

static void *race_of_thread(void *context)
{
    (void)context;
    int left = ITEMS_OF_THREADS;
    while (left > 0) {
        left = 0;
        for (int i = 0; i < ITEMS_OF_THREADS; i++)
            left += !make_item(i, thread_log);
    }
    return NULL;
}

static void each_is_made_once_by_threads(void **state)
{
    pthread_t threads[RACERS];
    (void)state;
    thread_log = open("log", O_WRONLY | O_APPEND | O_CREAT, 0666);
    for (int i = 0; i < RACERS; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, race_of_thread, NULL), 0);
    for (int i = 0; i < RACERS; i++)
        assert_int_equal(pthread_join(threads[i], NULL), 0);
    close(thread_log);
    check_race(ITEMS_OF_THREADS);
}

/* A process that is at an item when it is killed: its first output is begun, or in place and the second
 * begun. */
static void kill_one_at_work(char *const *outputs, bool first_is_made)
{
    int ready[2], status;
    char sign;
    assert_int_equal(pipe(ready), 0);
    const pid_t child = fork();
    if (child == 0) {
        tl_frame_claim *claim = NULL;
        tl_atomic_file file = {0};
        if (tl_frame_claim_take(outputs, 2, &claim, NULL) != TL_OK || !claim ||
            (first_is_made && tl_whole_file_write(outputs[0], "old", 3, NULL) != TL_OK) ||
            tl_atomic_file_begin(&file, outputs[first_is_made], NULL) != TL_OK ||
            tl_write_all(file.descriptor, "much more than will be", 22) != 0 ||
            write(ready[1], "", 1) != 1)
            _exit(1);
        pause();
    }
    assert_int_equal(read(ready[0], &sign, 1), 1);
    tl_frame_claim *claim = NULL;
    tl_error err;
    ASSERT_OK(tl_frame_claim_take(outputs, 2, &claim, &err), err);
    assert_null(claim);
    tl_frame_claim_sweep(outputs, 2);
    assert_int_equal(count_names("."), 2);
    kill(child, SIGKILL);
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFSIGNALED(status));
    close(ready[0]);
    close(ready[1]);
}

static void the_killed_are_followed(void **state)
{
    (void)state;
    item it;
    tl_error err;
    name_item(&it, 1);
    for (int made = 0; made <= 1; made++) {
        tl_frame_claim *claim = NULL;
        kill_one_at_work(it.outputs, made);
        assert_int_equal(count_names("."), 2);
        ASSERT_OK(tl_frame_claim_take(it.outputs, 2, &claim, &err), err);
        assert_non_null(claim);
        ASSERT_OK(tl_whole_file_write(it.outputs[0], "a", 1, &err), err);
        ASSERT_OK(tl_whole_file_write(it.outputs[1], "b", 1, &err), err);
        tl_frame_claim_end(claim);
        assert_holds(it.outputs[0], "a");
        assert_holds(it.outputs[1], "b");
        assert_int_equal(count_names("."), 2);
        remove(it.outputs[0]);
        remove(it.outputs[1]);
    }
}

/* Of an item that is up to date, so that no one takes it again. */
static void leavings_are_swept(void **state)
{
    (void)state;
    item it;
    name_item(&it, 1);
    kill_one_at_work(it.outputs, true);
    assert_int_equal(count_names("."), 2);
    tl_frame_claim_sweep(it.outputs, 2);
    tl_frame_claim_sweep(it.outputs, 2);
    assert_int_equal(count_names("."), 1);
    remove(it.outputs[0]);
}

/* Within one process, as its threads are. Files that are not claimed have temporary names of their own. */
static void in_one_process(void **state)
{
    (void)state;
    item it;
    tl_error err;
    tl_frame_claim *first = NULL, *second = NULL;
    tl_atomic_file file = {0}, other = {0};
    name_item(&it, 1);
    char *turned[] = {it.outputs[1], it.outputs[0]}, *alone[] = {it.outputs[1]};
    ASSERT_OK(tl_frame_claim_take(it.outputs, 2, &first, &err), err);
    assert_non_null(first);
    ASSERT_OK(tl_frame_claim_take(turned, 2, &second, &err), err);
    assert_null(second);
    ASSERT_OK(tl_frame_claim_take(alone, 1, &second, &err), err);
    assert_null(second);
    ASSERT_OK(tl_atomic_file_begin(&file, it.outputs[0], &err), err);
    ASSERT_OK(tl_atomic_file_begin(&other, "other", &err), err);
    assert_int_equal(count_names("."), 3);
    tl_atomic_file_abandon(&other);
    /* A claim outlives what is given up, and is begun again empty. */
    assert_int_equal(tl_write_all(file.descriptor, "given up", 8), 0);
    tl_atomic_file_abandon(&file);
    assert_int_equal(count_names("."), 2);
    ASSERT_OK(tl_frame_claim_take(it.outputs, 2, &second, &err), err);
    assert_null(second);
    ASSERT_OK(tl_whole_file_write(it.outputs[0], "a", 1, &err), err);
    assert_holds(it.outputs[0], "a");
    /* One is in place, the other is not: the item is still taken. */
    ASSERT_OK(tl_frame_claim_take(it.outputs, 2, &second, &err), err);
    assert_null(second);
    /* Written again, it is as any file. */
    ASSERT_OK(tl_whole_file_write(it.outputs[0], "again", 5, &err), err);
    assert_holds(it.outputs[0], "again");
    assert_int_equal(count_names("."), 2);
    tl_frame_claim_end(first);
    assert_int_equal(count_names("."), 1);
    ASSERT_OK(tl_frame_claim_take(turned, 2, &second, &err), err);
    assert_non_null(second);
    tl_frame_claim_end(second);
    tl_frame_claim_end(NULL);
    assert_holds(it.outputs[0], "again");
    assert_int_equal(count_names("."), 1);
    remove(it.outputs[0]);
}

/* What happens once, just before the library locks a file, or removes one. */
static void (*before_lock)(void), (*before_unlink)(void);

static void happen(void (**what)(void))
{
    void (*const now)(void) = *what;
    if (!now)
        return;
    *what = NULL;
    now();
}

/* In the place of the C library's. */
int fcntl(int descriptor, int command, ...)
{
    va_list arguments;
    va_start(arguments, command);
    void *const argument = va_arg(arguments, void *);
    va_end(arguments);
    if (command == F_OFD_SETLK)
        happen(&before_lock);
    return (int)syscall(SYS_fcntl, descriptor, command, argument);
}

int unlink(const char *path)
{
    happen(&before_unlink);
    return (int)syscall(SYS_unlink, path);
}

static char *only[] = {(char[]){"only"}};
static tl_frame_claim *others;

static void other_makes_it(void)
{
    tl_error err;
    ASSERT_OK(tl_whole_file_write(only[0], "made", 4, &err), err);
    tl_frame_claim_end(others);
}

static void other_gives_up(void)
{
    tl_frame_claim_end(others);
}

/* Who has the lock renames or removes the file that has been opened to be locked: another is made. */
static void opened_too_early(void **state)
{
    static void (*const cases[])(void) = {other_makes_it, other_gives_up};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        tl_error err;
        tl_atomic_file file = {0};
        tl_frame_claim *claim = NULL;
        ASSERT_OK(tl_frame_claim_take(only, 1, &others, &err), err);
        before_lock = cases[i];
        ASSERT_OK(tl_frame_claim_take(only, 1, &claim, &err), err);
        assert_null(before_lock);
        assert_non_null(claim);
        ASSERT_OK(tl_atomic_file_begin(&file, only[0], &err), err);
        assert_true(is_there(file.temporary));
        tl_atomic_file_abandon(&file);
        tl_frame_claim_end(claim);
        if (i == 0)
            assert_holds(only[0], "made");
        remove(only[0]);
        assert_int_equal(count_names("."), 0);
    }
}

static void must_be_locked(void)
{
    tl_error err;
    tl_frame_claim *claim = NULL;
    ASSERT_OK(tl_frame_claim_take(only, 1, &claim, &err), err);
    assert_null(claim);
}

static void removed_while_locked(void **state)
{
    (void)state;
    tl_error err;
    tl_frame_claim *claim = NULL;
    ASSERT_OK(tl_frame_claim_take(only, 1, &claim, &err), err);
    before_unlink = must_be_locked;
    tl_frame_claim_end(claim);
    assert_null(before_unlink);
}

/* What has become the output is another's name now. */
static void removed_unless_renamed(void **state)
{
    (void)state;
    tl_error err;
    tl_frame_claim *first = NULL, *second = NULL;
    ASSERT_OK(tl_frame_claim_take(only, 1, &first, &err), err);
    ASSERT_OK(tl_whole_file_write(only[0], "made", 4, &err), err);
    ASSERT_OK(tl_frame_claim_take(only, 1, &second, &err), err);
    assert_non_null(second);
    assert_int_equal(count_names("."), 2);
    tl_frame_claim_end(first);
    assert_int_equal(count_names("."), 2);
    tl_frame_claim_end(second);
    assert_int_equal(count_names("."), 1);
    remove(only[0]);
}

/* By other names, over a link, and names as long as can be that differ at the end. */
static void names_lead_to_one_claim(void **state)
{
    (void)state;
    tl_error err;
    char long_name[256], other[256];
    char *direct[] = {(char[]){"real"}}, *linked[] = {(char[]){"link"}},
         *around[] = {(char[]){"././real"}};
    char *longest[] = {long_name}, *another[] = {other};
    tl_frame_claim *first = NULL, *second = NULL;
    assert_int_equal(symlink("real", "link"), 0);
    ASSERT_OK(tl_frame_claim_take(direct, 1, &first, &err), err);
    ASSERT_OK(tl_frame_claim_take(linked, 1, &second, &err), err);
    assert_null(second);
    ASSERT_OK(tl_frame_claim_take(around, 1, &second, &err), err);
    assert_null(second);
    tl_frame_claim_end(first);
    remove("link");
    memset(long_name, 'n', sizeof long_name - 1);
    long_name[255] = '\0';
    memcpy(other, long_name, sizeof other);
    other[254] = 'm';
    ASSERT_OK(tl_frame_claim_take(longest, 1, &first, &err), err);
    ASSERT_OK(tl_frame_claim_take(another, 1, &second, &err), err);
    assert_non_null(second);
    ASSERT_OK(tl_whole_file_write(long_name, "x", 1, &err), err);
    tl_frame_claim_end(first);
    tl_frame_claim_end(second);
    assert_int_equal(count_names("."), 1);
    remove(long_name);
}

static void what_cannot_be_taken(void **state)
{
    static const struct {
        const char *output;
        const char *words[3];
    } cases[] = {
        {"absent/x", {"absent/x", "No such file", NULL}},
        {"/dev/null", {"/dev/null", "no regular file", NULL}},
        {".", {"name a file in it", NULL}},
        {"", {"No such file", NULL}},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        tl_error err;
        char second[64];
        char *outputs[] = {(char[]){"fine"}, second};
        tl_frame_claim *claim = NULL;
        snprintf(second, sizeof second, "%s", cases[i].output);
        assert_refused(second, tl_frame_claim_take(outputs, 2, &claim, &err), TL_ERR_WRITE,
                       &err, cases[i].words);
        assert_int_equal(count_names("."), 0);
        tl_frame_claim_sweep(outputs, 2);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_is_made_once),
        cmocka_unit_test(each_is_made_once_by_threads),
        cmocka_unit_test(the_killed_are_followed),
        cmocka_unit_test(leavings_are_swept),
        cmocka_unit_test(in_one_process),
        cmocka_unit_test(opened_too_early),
        cmocka_unit_test(removed_while_locked),
        cmocka_unit_test(removed_unless_renamed),
        cmocka_unit_test(names_lead_to_one_claim),
        cmocka_unit_test(what_cannot_be_taken),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
