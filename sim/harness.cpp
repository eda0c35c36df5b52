// SPDX-License-Identifier: Apache-2.0
// Drives a Verilated module from arrays: one row of inputs a transfer, one row of outputs a transfer, clock by clock.
//
// Included behind a generated part (sim/model.py) that defines
//   DUT, CLOCKED, OUT_VALID, OUT_PORTS, STATUS_PORTS   the module's class and what it has
//   set_clock, set_reset, set_phase, set_in_valid, set_out_ready  drive a port, if it is there
//   in_ready, out_valid                                read one; true where there is none
//   drive, collect, read_status                        a row of inputs, of outputs, the status
//   AXIL                                               1: the module has registers on s_axil_*
//   set_mutant                                         choose a fault that the netlist holds; 0: none
// and WAVES, COVERAGE. The generated part knows the names, this file the protocol:
//
//   registers         are written after reset, before the streams, and read when these are drained
//   CLOCKED = false   combinational: a row is evaluated at once
//   input             transfers when it is offered and in_ready
//   phase             counts 0 to `pace` - 1 from reset on; where the module has one, an input is taken in phase `take`
//   output            transfers when valid and ready; without OUT_VALID a row leaves `latency` clocks after it entered

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>
#if COVERAGE
#include <string>
#include <unistd.h>
#include "verilated_cov.h"
#endif

namespace {

#if COVERAGE
// Counts of lines, branches and toggles into the folder that POLYSHADE_COVERAGE names, a file a run
void cover(VerilatedContext& context) {
    static int number = 0;
    const char* folder = std::getenv("POLYSHADE_COVERAGE");
    if (!folder) return;
    const std::string name = std::to_string(getpid()) + "-" + MODEL_KEY + "-" + std::to_string(number++) + ".dat";
    context.coveragep()->write((std::string(folder) + "/" + name).c_str());
}
#else
void cover(VerilatedContext&) {}
#endif

struct Random {  // xorshift64*: fast, and the same sequence everywhere
    uint64_t state;
    bool chance(uint32_t of_65536) {
        state ^= state >> 12;
        state ^= state << 25;
        state ^= state >> 27;
        return ((state * 0x2545F4914F6CDD1DULL) >> 48) < of_65536;
    }
};

struct Session {
    VerilatedContext context;
    DUT* top = nullptr;
    std::vector<std::vector<uint64_t>> out;  // a vector a port, `words` entries a row
    std::vector<uint64_t> taken, given;      // the clock of every transfer
    uint64_t clocks = 0;
    uint64_t resting = 0;  // clocks in which the streams rest
    uint64_t status[STATUS_PORTS + 1] = {};
#if WAVES
    VerilatedVcdC trace;
#endif

    Session(uint64_t state, uint64_t mutant, const char* waves) : out(OUT_PORTS) {
        context.randReset(2);  // registers without reset start with random contents
        context.randSeed(int(state % 0x7fffffff) + 1);  // 0 would be another seed at every run
#if WAVES
        context.traceEverOn(true);
#endif
        top = new DUT{&context};
#if WAVES
        top->trace(&trace, 99);
        trace.open(waves);
#else
        (void)waves;
#endif
        set_mutant(*top, mutant);
    }
    ~Session() {
        top->final();
        cover(context);
        delete top;
    }
    void eval() {
        top->eval();
#if WAVES
        trace.dump(context.time());
        context.timeInc(1);
#endif
    }
};

struct Stop {};  // an assertion failed
bool ours = false;  // the main loop is model_run's

#if AXIL
// A word [0]: offset, [1]: what is written, or read. 0: done; 2: an error response; 3: no answer for `patience` clocks
int access(Session& s, bool write, uint32_t* word, uint64_t patience) {
    DUT& t = *s.top;
    t.s_axil_awvalid = t.s_axil_wvalid = t.s_axil_bready = write;
    t.s_axil_arvalid = t.s_axil_rready = !write;
    t.s_axil_awaddr = t.s_axil_araddr = word[0];
    t.s_axil_wdata = word[1];
    for (const uint64_t end = s.resting + patience; s.resting < end; s.resting++) {
        set_clock(t, 0);
        s.eval();
        const bool aw = t.s_axil_awready, w = t.s_axil_wready, ar = t.s_axil_arready;
        const bool answer = write ? t.s_axil_bvalid : t.s_axil_rvalid;
        const bool error = write ? t.s_axil_bresp : t.s_axil_rresp;
        if (!write) word[1] = t.s_axil_rdata;
        set_clock(t, 1);
        s.eval();
        if (aw) t.s_axil_awvalid = 0;
        if (w) t.s_axil_wvalid = 0;
        if (ar) t.s_axil_arvalid = 0;
        if (answer) return error ? 2 : 0;
    }
    return 3;
}

void rest(DUT& t) {
    t.s_axil_awvalid = t.s_axil_wvalid = t.s_axil_arvalid = t.s_axil_bready = t.s_axil_rready = 0;
    t.s_axil_awprot = t.s_axil_arprot = 0;
    t.s_axil_wstrb = 0xf;
}
#else
int access(Session&, bool, uint32_t*, uint64_t) { return 0; }
void rest(DUT&) {}
#endif

}  // namespace

// Verilator's runtime calls it behind an assertion that failed, whose line is on standard output by then
void vl_stop(const char*, int, const char*) {
    std::fflush(stdout);
    if (ours) throw Stop{};
    Verilated::threadContextp()->gotError(true);
    Verilated::threadContextp()->gotFinish(true);
}

// ... where the logic has a loop that does not settle, as a mutant's may
void vl_fatal(const char* file, int line, const char* scope, const char* told) {
    std::fprintf(stderr, "%s:%d: %s: %s\n", file, line, scope, told);
    if (ours) throw Stop{};
    std::exit(1);
}

extern "C" {

struct Job {
    uint64_t rows;
    const void* const* in;
    uint32_t in_gap, out_stall;  // probabilities in 1/65536 a clock
    uint64_t seed, state;  // of gaps and stalls; of registers without reset
    uint64_t reset_at;  // a clock with reset, behind which everything begins anew; ~0: none
    uint64_t most;  // clocks, after which the module is given up
    uint64_t mutant;
    uint64_t latency, pace, take, drain, patience;
    const char* waves;
    uint32_t (*words)[2];  // offset and word, of registers to write, then of those to read
    uint64_t writes, reads;
    uint64_t given;  // out: number of rows
    uint64_t clocks;  // out: up to and with the last transfer of an output
    uint64_t simulated;  // out: all clocks
    uint64_t accesses;  // out: registers that were written and read
};

// All of them up to number `end`, or to the first that fails; results as of access
int accesses(Session& s, Job& job, bool write, uint64_t end) {
    int result = 0;
    for (; !result && job.accesses < end; job.accesses += !result)
        result = access(s, write, job.words[job.accesses], job.patience);
    rest(*s.top);
    return result;
}

// Forget what was, behind a reset
void again(Session& s, Job& job) {
    set_reset(*s.top, 0);
    set_in_valid(*s.top, 0);
    set_out_ready(*s.top, 0);
    s.taken.clear();
    s.given.clear();
    for (auto& port : s.out) port.clear();
    job.reset_at = ~0ULL;
    job.accesses = 0;
}

// 0: done; 1: the module took no input and gave no output for `patience` clocks; 2, 3: see access, of word `accesses`;
// 4: an assertion failed
int model_run(Job* job, void** session) try {
    ours = true;
    auto* s = new Session(job->state, job->mutant, job->waves);
    *session = s;
    Random random{job->seed * 2654435761u + 88172645463325252ULL};
    uint64_t next = 0, quiet = 0, clock = 0;
    bool offer = false;
    int result = 0;
    s->taken.reserve(job->rows);
    s->given.reserve(job->rows);
    for (auto& port : s->out) port.reserve(job->rows);

    if (!CLOCKED) {
        for (; next < job->rows; next++, clock++) {
            drive(*s->top, job->in, next);
            s->eval();
            s->taken.push_back(clock);
            s->given.push_back(clock);
            collect(*s->top, s->out);
        }
    } else {
        if (job->rows) drive(*s->top, job->in, 0);  // settings among the inputs
        rest(*s->top);
        set_reset(*s->top, 1);
        set_phase(*s->top, job->take);
        set_in_valid(*s->top, 0);
        set_out_ready(*s->top, 0);
        for (int i = 0; i < 3; i++) {
            set_clock(*s->top, 0);
            s->eval();
            set_clock(*s->top, 1);
            s->eval();
        }
        set_reset(*s->top, 0);
        result = accesses(*s, *job, true, job->writes);
        for (; !result; clock++) {
            const uint64_t phase = clock % job->pace;
            set_clock(*s->top, 0);
            set_reset(*s->top, clock == job->reset_at);
            set_phase(*s->top, (phase + job->take) % job->pace);
            if (!offer && next < job->rows && !(job->in_gap && random.chance(job->in_gap))) {
                drive(*s->top, job->in, next);
                offer = true;
            }
            set_in_valid(*s->top, offer);
            const bool ready = !(job->out_stall && random.chance(job->out_stall));
            set_out_ready(*s->top, ready);
            s->eval();

            const bool take = offer && in_ready(*s->top) && !phase;
            const size_t due = s->given.size();
            if (take) {
                s->taken.push_back(clock);
                next++;
                offer = false;
            }
            const bool valid = OUT_VALID ? out_valid(*s->top)
                                         : due < s->taken.size() && s->taken[due] + job->latency == clock;
            const bool give = valid && ready;
            if (give) {
                s->given.push_back(clock);
                s->clocks = clock + 1;
                collect(*s->top, s->out);
            }
            quiet = take || give ? 0 : quiet + 1;

            set_clock(*s->top, 1);
            s->eval();
            if (clock == job->reset_at) {
                again(*s, *job);
                next = quiet = 0;
                clock = ~0ULL;  // the next is 0
                offer = false;
                result = accesses(*s, *job, true, job->writes);
                continue;
            }
            if (next >= job->rows && !valid && quiet >= job->drain && (OUT_VALID || due == job->rows)) break;
            if (quiet >= job->patience + job->drain || clock >= job->most) {
                result = 1;
                break;
            }
        }
        set_in_valid(*s->top, 0);
        set_out_ready(*s->top, 0);
        if (!result) result = accesses(*s, *job, false, job->writes + job->reads);
        read_status(*s->top, s->status);
    }
    job->given = s->given.size();
    job->clocks = CLOCKED ? s->clocks : clock;
    job->simulated = clock + s->resting;
    return result;
} catch (const Stop&) {
    return 4;
}

const uint64_t* model_out(void* session, int port) { return static_cast<Session*>(session)->out[port].data(); }
const uint64_t* model_taken(void* session) { return static_cast<Session*>(session)->taken.data(); }
const uint64_t* model_given(void* session) { return static_cast<Session*>(session)->given.data(); }
uint64_t model_taken_rows(void* session) { return static_cast<Session*>(session)->taken.size(); }
const uint64_t* model_status(void* session) { return static_cast<Session*>(session)->status; }
void model_free(void* session) { delete static_cast<Session*>(session); }

// The bare module, for whoever brings a main loop of his own: cocotb, through tb/Vtop.h
void* dut_new(const char* name) {
    auto* dut = new DUT{name};
    const char* mutant = std::getenv("MUTANT");
    set_mutant(*dut, mutant ? std::strtoull(mutant, nullptr, 10) : 0);
    return dut;
}
void dut_delete(void* dut) { delete static_cast<DUT*>(dut); }
void dut_eval_step(void* dut) { static_cast<DUT*>(dut)->eval_step(); }
void dut_eval_end_step(void* dut) { static_cast<DUT*>(dut)->eval_end_step(); }
void dut_final(void* dut) {
    static_cast<DUT*>(dut)->final();
    cover(*Verilated::threadContextp());
}
#if WAVES
void dut_trace(void* dut, VerilatedVcdC* to, int levels) { static_cast<DUT*>(dut)->trace(to, levels); }
#endif

}  // extern "C"
