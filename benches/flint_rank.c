/* The rank of a matrix by FLINT, for comparison: nmod_mat_rank or fmpz_mat_rank.
 *
 *   gcc -O2 -o flint_rank benches/flint_rank.c -lflint -lmpfr -lgmp
 *   flint_rank < MATRIX        (as the example `matrix` writes it)
 *
 * Prints the rank, the seconds of the rank computation alone (CPU and wall clock), and the
 * peak memory of the process.
 */
#include <flint/flint.h>
#include <flint/fmpz_mat.h>
#include <flint/nmod_mat.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <time.h>

static double seconds(clockid_t clock)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return now.tv_sec + 1e-9 * now.tv_nsec;
}

static void refuse(const char *why)
{
    fprintf(stderr, "flint_rank: %s\n", why);
    exit(2);
}

int main(void)
{
    unsigned long rows, cols, modulus, row, col;
    char value[4096];
    fmpz_t entry;
    fmpz_mat_t integers;
    nmod_mat_t residues;
    slong rank;
    double cpu, wall;
    struct rusage usage;

    if (scanf("%lu %lu %lu", &rows, &cols, &modulus) != 3)
        refuse("no matrix on standard input");
    fmpz_init(entry);
    if (modulus == 0)
        fmpz_mat_init(integers, rows, cols);
    else
        nmod_mat_init(residues, rows, cols, modulus);
    while (scanf("%lu %lu %4095s", &row, &col, value) == 3) {
        if (row >= rows || col >= cols || fmpz_set_str(entry, value, 10) != 0)
            refuse("bad entry");
        if (modulus == 0)
            fmpz_set(fmpz_mat_entry(integers, row, col), entry);
        else
            nmod_mat_entry(residues, row, col) = fmpz_get_ui(entry);
    }
    if (!feof(stdin))
        refuse("bad entry");

    cpu = seconds(CLOCK_PROCESS_CPUTIME_ID);
    wall = seconds(CLOCK_MONOTONIC);
    rank = modulus == 0 ? fmpz_mat_rank(integers) : nmod_mat_rank(residues);
    cpu = seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu;
    wall = seconds(CLOCK_MONOTONIC) - wall;

    getrusage(RUSAGE_SELF, &usage);
    printf("{\"library\": \"FLINT %s\", \"rows\": %lu, \"cols\": %lu, \"modulus\": %lu, "
           "\"rank\": %ld, \"cpu\": %.6f, \"wall\": %.6f, \"peak_kib\": %ld}\n",
           FLINT_VERSION, rows, cols, modulus, (long) rank, cpu, wall, usage.ru_maxrss);
    return 0;
}
