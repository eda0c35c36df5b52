"""cocotb benches of rtl/fixed."""
