// The pipeline as a SystemC module with the ports of the RTL: a fast model of it in a virtual platform.
//
// Outputs follow inputs and registers as in hardware: in_ready_o depends on out_ready_i in the same cycle.
#ifndef BLYSK_MODULE_H
#define BLYSK_MODULE_H

#include <cstdint>
#include <systemc>

#include "blysk.h"

class blysk_module : public sc_core::sc_module {
public:
    sc_core::sc_in<bool> clk_i, rst_i, in_valid_i, out_ready_i;
    sc_core::sc_in<std::uint32_t> address_i;
    sc_core::sc_in<std::int64_t> x_i;  // bits in the input format
    sc_core::sc_out<bool> in_ready_o, out_valid_o;
    sc_core::sc_out<std::int64_t> intensity_o;  // bits in the output format
    sc_core::sc_out<unsigned> status_o;

    SC_HAS_PROCESS(blysk_module);

    // The model may be freed after this; the module keeps what it needs.
    blysk_module(sc_core::sc_module_name name, const blysk_model *model) : sc_module(name) {
        need(blysk_pipeline_new(model, &pipeline));
        SC_METHOD(clocked);
        sensitive << clk_i.pos();
        dont_initialize();
        SC_METHOD(combinational);
        sensitive << rst_i << in_valid_i << out_ready_i << address_i << x_i << edge;
    }

    ~blysk_module() override { blysk_pipeline_free(pipeline); }

    blysk_module(const blysk_module &) = delete;
    blysk_module &operator=(const blysk_module &) = delete;

private:
    blysk_pipeline *pipeline = nullptr;
    sc_core::sc_event edge;  // registers have changed

    static void need(blysk_code code) {
        if (code != BLYSK_CODE_OK) SC_REPORT_FATAL("blysk", blysk_last_error());
    }

    blysk_outputs outputs() {
        blysk_inputs inputs{};
        inputs.reset = rst_i.read();
        inputs.in_valid = in_valid_i.read();
        inputs.out_ready = out_ready_i.read();
        inputs.address = address_i.read();
        inputs.x = x_i.read();
        blysk_outputs shown{};
        need(blysk_pipeline_combinational(pipeline, &inputs, &shown));
        return shown;
    }

    // At the edge signals still have what they had before it.
    void clocked() {
        outputs();
        need(blysk_pipeline_clock(pipeline));
        edge.notify(sc_core::SC_ZERO_TIME);
    }

    void combinational() {
        const blysk_outputs shown = outputs();
        in_ready_o.write(shown.in_ready);
        out_valid_o.write(shown.out_valid);
        intensity_o.write(shown.intensity);
        status_o.write(shown.status);
    }
};

#endif
