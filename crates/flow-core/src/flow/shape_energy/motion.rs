//! How positions and tangents move with the state.

use super::ShapeEnergy;

impl ShapeEnergy {
    /// Motion of tangents and positions under the motion `v` of the state; that of the tangent angle is in `angle`.
    pub(super) fn embed_motion(&mut self, v: &[f64]) {
        let (nodes, length) = (self.grid.nodes() as f64, self.frozen.shape.length);
        self.motion.length = v[self.layout.length_index()];
        if let Some(field) = self.metric {
            // δw = (δg − w δL)/L.
            self.spectrum.copy_from_slice(&self.layout.spectra(v)[self.layout.spectrum(field)]);
            self.motion.length = self.spectrum[0].re;
            self.grid.synthesise(&self.spectrum, &mut self.motion.weight);
            for (change, weight) in self.motion.weight.iter_mut().zip(&self.frozen.shape.weight) {
                *change = (*change - weight * self.motion.length) / length;
            }
        }
        self.spectrum.copy_from_slice(&self.layout.spectra(v)[..self.grid.modes()]);
        let turning_per_node = self.spectrum[0].re / nodes;
        self.grid.integrate(&mut self.spectrum);
        self.grid.synthesise(&self.spectrum, &mut self.angle);
        for (i, angle) in self.angle.iter_mut().enumerate() {
            *angle += turning_per_node * i as f64;
        }
        let sawtooth = self.frozen.sawtooth;
        let shortening = sawtooth.map_or(0.0, |at| at.first() * self.layout.spectra(v)[at.mode].re);
        let [c, s] = self.frozen.shape.tangents();
        for (i, angle) in self.angle.iter().enumerate() {
            let stretch = match self.metric {
                Some(_) => shortening + self.motion.weight[i] / self.frozen.shape.weight[i],
                None => shortening,
            };
            self.motion.tangent[0][i] = stretch * c[i] - s[i] * angle;
            self.motion.tangent[1][i] = stretch * s[i] + c[i] * angle;
        }
        let stretch = self.motion.length / length;
        for axis in 0..2 {
            self.grid.transform(&self.motion.tangent[axis], &mut self.spectrum);
            self.grid.integrate(&mut self.spectrum);
            self.grid.synthesise(&self.spectrum, &mut self.motion.position[axis]);
            let positions = self.motion.position[axis].iter_mut().zip(&self.frozen.shape.position[axis]);
            positions.for_each(|(motion, x)| *motion = length * *motion + stretch * x);
        }
    }
}
