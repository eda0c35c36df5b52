"""cocotb benches of rtl/stream."""
