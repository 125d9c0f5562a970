"""The paper's statements against the numbers of this program, and a judgement on each."""
