//! The clocked pipeline, with the design that it needs.

use std::ops::Deref;
use std::sync::Arc;

use hw_model::datapath::Datapath;
use hw_model::design::Design;
use sim::pipeline::{self, Inputs, Outputs, Rank};

use crate::error::Error;
use crate::handle::Model;

/// The data path of a design that is shared.
#[derive(Debug, Clone)]
struct Shared(Arc<Design>);

impl Deref for Shared {
    type Target = Datapath;

    fn deref(&self) -> &Datapath {
        self.0.datapath()
    }
}

/// The clocked pipeline of a model: one call a clock cycle.
#[derive(Debug, Clone)]
pub struct Clocked {
    model: Model,
    pipeline: pipeline::Clocked<Shared>,
}

impl Clocked {
    /// An empty pipeline, as after reset.
    #[must_use]
    pub fn new(model: &Model) -> Self {
        let pipeline = pipeline::Clocked::new(Shared(Arc::clone(model.shared_design())));
        Self { model: model.clone(), pipeline }
    }

    /// The model that is clocked.
    #[must_use]
    pub const fn model(&self) -> &Model {
        &self.model
    }

    /// One clock cycle: what the ports show at the rising edge that ends it, and then the edge.
    ///
    /// # Errors
    /// When the input format does not hold the bits of x; then no cycle has passed.
    pub fn tick(&mut self, inputs: &Inputs) -> Result<Outputs, Error> {
        self.model.held(inputs.x)?;
        Ok(self.pipeline.tick(inputs))
    }

    /// What the ports show with these inputs before the edge, which [`clock`](Self::clock) then brings.
    ///
    /// # Errors
    /// As [`tick`](Self::tick).
    pub fn combinational(&mut self, inputs: &Inputs) -> Result<Outputs, Error> {
        self.model.held(inputs.x)?;
        Ok(self.pipeline.combinational(inputs))
    }

    /// The rising edge with the inputs of the last [`combinational`](Self::combinational).
    pub fn clock(&mut self) {
        self.pipeline.clock();
    }

    /// Every rank before the next edge, the first one first. A probe of the model reads a rank's signals:
    /// `probe.register.bits(&rank.signals)`.
    pub fn ranks(&mut self) -> Vec<Rank> {
        self.pipeline.ranks().iter().collect()
    }

    /// True when no rank holds a request.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.pipeline.is_empty()
    }
}
