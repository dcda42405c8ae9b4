# Valgrind does not know the store form of vmovq between two registers, which the assembler takes where
# it is a byte shorter. The load form does the same.
.macro vmovq operands:vararg
{load} vmovq \operands
.endm
