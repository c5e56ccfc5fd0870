// Drives blysk_module with requests, stalls and bubbles, and holds every result against the model's own answer, and
// every cycle's handshake against a scoreboard.
//
//   c++ -std=c++17 systemc.cpp $(pkg-config --cflags --libs blysk) -lsystemc && ./a.out
#include <deque>
#include <iostream>

#include "blysk_module.h"

namespace {

constexpr unsigned REQUESTS = 4096;

// Fails as a testbench does, with the library's own sentence.
bool need(blysk_code code) {
    if (code != BLYSK_CODE_OK) std::cout << "FAIL " << blysk_last_error() << '\n';
    return code == BLYSK_CODE_OK;
}

std::uint32_t draw(std::uint32_t &state) {
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return state;
}

struct request {
    std::uint32_t address;
    std::int64_t x;
};

}  // namespace

int sc_main(int, char *[]) {
    blysk_model *model = nullptr;
    blysk_scoreboard *scoreboard = nullptr;
    blysk_interface ports;
    if (!need(blysk_model_preset(BLYSK_ABI_VERSION, "compact", &model))) return 2;
    if (!need(blysk_model_interface(model, &ports)) || !need(blysk_scoreboard_new(model, &scoreboard))) return 2;

    sc_core::sc_signal<bool> clk, rst, in_valid, out_ready, in_ready, out_valid;
    sc_core::sc_signal<std::uint32_t> address;
    sc_core::sc_signal<std::int64_t> x, intensity;
    sc_core::sc_signal<unsigned> status;
    blysk_module dut("dut", model);
    dut.clk_i(clk), dut.rst_i(rst), dut.in_valid_i(in_valid), dut.out_ready_i(out_ready);
    dut.address_i(address), dut.x_i(x), dut.in_ready_o(in_ready), dut.out_valid_o(out_valid);
    dut.intensity_o(intensity), dut.status_o(status);

    const sc_core::sc_time half(5, sc_core::SC_NS);
    std::deque<request> requests;
    std::uint32_t random = 1;
    unsigned sent = 0, received = 0;
    bool waits = false, right = true;
    for (unsigned cycle = 0; right && received < REQUESTS; cycle++) {
        const std::uint32_t drawn = draw(random);
        rst = cycle < 2;
        out_ready = drawn % 4 != 0;
        if (!waits) {
            in_valid = cycle >= 2 && sent < REQUESTS && drawn / 4 % 4 != 0;
            address = draw(random) % ports.depth;
            x = std::int64_t(draw(random) & ((std::uint64_t(1) << ports.x.fraction_bits) - 1));
        }
        clk = false;
        sc_core::sc_start(half);

        // What every port shows just before the edge.
        blysk_ports seen{};
        seen.reset = rst, seen.in_valid = in_valid, seen.in_ready = in_ready;
        seen.out_valid = out_valid, seen.out_ready = out_ready;
        seen.address = address, seen.x = std::uint64_t(x.read());
        seen.intensity = std::uint64_t(intensity.read()), seen.status = status;
        right = need(blysk_scoreboard_cycle(scoreboard, &seen));
        if (out_valid && out_ready && !rst) {
            std::int64_t expected = 0;
            std::uint8_t flags = 0;
            const request oldest = requests.front();
            requests.pop_front();
            right = right && need(blysk_evaluate(model, &oldest.address, 1, &oldest.x, 1, &expected, &flags));
            right = right && expected == intensity && flags == status;
            received++;
        }
        if (in_valid && in_ready) requests.push_back({address, x}), sent++;
        waits = in_valid && !in_ready;
        clk = true;
        sc_core::sc_start(half);
    }
    blysk_verdict verdict;
    right = need(blysk_scoreboard_verdict(scoreboard, &verdict)) && verdict.passed && right;
    std::cout << verdict.cycles << " cycles, " << verdict.stalls << " stalls, " << verdict.bubbles << " bubbles\n";
    std::cout << verdict.line << '\n';
    blysk_scoreboard_free(scoreboard);
    blysk_model_free(model);
    return right ? 0 : 1;
}
