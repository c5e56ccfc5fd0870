// The same from C++: handles that free themselves, codes that become exceptions.
//
//   c++ -std=c++17 highlight.cpp $(pkg-config --cflags --libs blysk) && ./a.out
#include <cstdint>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "blysk.h"

namespace {

void need(blysk_code code) {
    if (code != BLYSK_CODE_OK) throw std::runtime_error(blysk_last_error());
}

struct Free {
    void operator()(blysk_model *model) const { blysk_model_free(model); }
    void operator()(blysk_pipeline *pipeline) const { blysk_pipeline_free(pipeline); }
};

std::unique_ptr<blysk_model, Free> preset(const std::string &name) {
    blysk_model *model = nullptr;
    need(blysk_model_preset(BLYSK_ABI_VERSION, name.c_str(), &model));
    return std::unique_ptr<blysk_model, Free>(model);
}

}  // namespace

int main() {
    try {
        const auto model = preset("precise");
        std::uint32_t address = 0;
        need(blysk_address(model.get(), 32.0, &address));
        std::vector<std::int64_t> x(1000), intensity(x.size());
        std::vector<std::uint8_t> status(x.size());
        for (std::size_t i = 0; i < x.size(); i++) need(blysk_x_bits(model.get(), double(i) / 999.0, &x[i]));
        need(blysk_evaluate(model.get(), &address, 1, x.data(), x.size(), intensity.data(), status.data()));
        std::cout << "x = 1 gives " << intensity.back() << ", x = 0 gives " << intensity.front() << '\n';

        try {
            preset("none");
        } catch (const std::runtime_error &error) {
            std::cout << "refused: " << error.what() << '\n';
            return 0;
        }
        return 1;
    } catch (const std::runtime_error &error) {
        std::cerr << "highlight: " << error.what() << '\n';
        return 2;
    }
}
