// Streams consecutive x of one address through the verilated pipeline, one a cycle, and writes each result as a 32-bit
// word {status, intensity} to standard output.
//
//   harness <address> <first x> <last x> <bits of an intensity> <cycles until the last result is out>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "Vblysk.h"
#include "verilated.h"

namespace {

constexpr std::size_t kBuffer = std::size_t{1} << 18;

class Stream {
public:
    explicit Stream(unsigned width) : width_{width} { words_.reserve(kBuffer); }

    // One clock cycle: the edge takes what the inputs show; a result may stand there afterwards.
    void cycle() {
        dut_.clk_i = 1;
        dut_.eval();
        if (dut_.out_valid_o) put((static_cast<std::uint32_t>(dut_.status_o) << width_) | dut_.intensity_o);
        dut_.clk_i = 0;
        dut_.eval();
    }

    void flush() {
        if (std::fwrite(words_.data(), sizeof words_[0], words_.size(), stdout) != words_.size()) std::exit(1);
        words_.clear();
    }

    Vblysk& dut() { return dut_; }

private:
    void put(std::uint32_t word) {
        words_.push_back(word);
        if (words_.size() == kBuffer) flush();
    }

    Vblysk dut_;
    unsigned width_;
    std::vector<std::uint32_t> words_;
};

}  // namespace

int main(int argc, char** argv) {
    if (argc != 6) return 2;
    const auto number = [argv](int index) { return std::strtoull(argv[index], nullptr, 10); };
    const auto address = number(1), first = number(2), last = number(3), latency = number(5);
    Stream stream{static_cast<unsigned>(number(4))};
    auto& dut = stream.dut();

    dut.rst_i = 1;
    dut.out_ready_i = 1;
    for (int i = 0; i < 2; ++i) stream.cycle();
    dut.rst_i = 0;
    dut.in_valid_i = 1;
    dut.address_i = address;
    for (std::uint64_t x = first; x <= last; ++x) {
        dut.x_i = x;
        stream.cycle();
    }
    // What is still inside comes out.
    dut.in_valid_i = 0;
    for (std::uint64_t i = 0; i < latency; ++i) stream.cycle();
    stream.flush();
    return 0;
}
