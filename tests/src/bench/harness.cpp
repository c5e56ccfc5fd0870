// The verilated pipeline under the stimulus of tests/src/bench/engines.rs: a request in every cycle, at random or of
// a sweep, each result taken at once. Prints cycles, seconds of the processor, and a checksum of all results.
//
//   harness random|sweep CYCLES [FILE.vcd]
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "Vblysk.h"
#include "verilated.h"
#if VM_TRACE
#include "verilated_vcd_c.h"
#endif

// Of the processor, so that others on the machine take nothing away.
static double seconds() {
    timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return time.tv_sec + 1e-9 * time.tv_nsec;
}

int main(int argc, char** argv) {
    const uint64_t cycles = std::strtoull(argv[2], nullptr, 10);
    const bool sweep = argv[1][0] == 's';
    VerilatedContext context;
#if VM_TRACE
    context.traceEverOn(true);
#endif
    Vblysk top{&context};
#if VM_TRACE
    VerilatedVcdC waves;
    top.trace(&waves, 99);
    if (argc > 3) waves.open(argv[3]);
#endif
    top.rst_i = 1;
    top.in_valid_i = 0;
    top.out_ready_i = 1;
    for (int edge = 0; edge < 6; ++edge) {
        top.clk_i = ~edge & 1;
        top.eval();
    }
    top.rst_i = 0;
    top.in_valid_i = 1;
    uint64_t state = SEED, checksum = 0, weight = 1;
    const double begin = seconds();
    for (uint64_t cycle = 0; cycle < cycles; ++cycle) {
        if (sweep) {
            top.address_i = ADDRESS;
            top.x_i = 0x7fffff - ((cycle & 0x7ffff) << 3);
        } else {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            top.address_i = state & 0xff;
            top.x_i = 0x7fffff - ((state >> 16 & 0x7fffff) >> (state >> 40 & 7));
        }
        if (top.out_valid_o) {
            const uint64_t result = uint64_t(top.intensity_o) << 4 | top.status_o;
            checksum += result * weight;
            weight += 2;
        }
        top.clk_i = 1;
        top.eval();
#if VM_TRACE
        if (argc > 3) waves.dump(10 * cycle + 5);
#endif
        top.clk_i = 0;
        top.eval();
#if VM_TRACE
        if (argc > 3) waves.dump(10 * cycle + 10);
#endif
    }
#if VM_TRACE
    if (argc > 3) waves.close();
#endif
    const double taken = seconds() - begin;
    std::printf("%llu %.9f %llu\n", (unsigned long long)cycles, taken, (unsigned long long)checksum);
    return 0;
}
