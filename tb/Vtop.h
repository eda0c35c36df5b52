// SPDX-License-Identifier: Apache-2.0
// The module in a compiled model, under the name and with the functions that cocotb's main program for Verilator uses.
// So that program is compiled once and linked to any model of sim/verilate.py; see sim/harness.cpp.
#pragma once
#include "verilated.h"
class VerilatedVcdC;

extern "C" {
void* dut_new(const char* name);
void dut_delete(void* dut);
void dut_eval_step(void* dut);
void dut_eval_end_step(void* dut);
void dut_final(void* dut);
void dut_trace(void* dut, VerilatedVcdC* to, int levels);
}

class Vtop {
    void* const dut;

  public:
    explicit Vtop(const char* name) : dut(dut_new(name)) {}
    ~Vtop() { dut_delete(dut); }
    void eval_step() { dut_eval_step(dut); }
    void eval_end_step() { dut_eval_end_step(dut); }
    void final() { dut_final(dut); }
    void trace(VerilatedVcdC* to, int levels) { dut_trace(dut, to, levels); }
    bool eventsPending() { return false; }  // the RTL has no delays
    uint64_t nextTimeSlot() { return 0; }
};
