//! Cases for the highlight pipeline and the files they travel in.
